// Repeats a query while a panel is open; waits for each answer before the next query.
import { useSignal, type Signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { Fields } from '../link/contract';
import { query, sentence } from '../link/commands';
import { link } from '../link/state';

export interface Polled<T> {
  data: Signal<T | null>;
  why: Signal<string>;
}

/** Polls until the returned function is called; pauses while the page is hidden or without a connection. */
export function poll<T>(name: string, fields: Fields, every_ms: number, { data, why }: Polled<T>): () => void {
  let live = true;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const look = async (): Promise<void> => {
    if (link.peek() === 'open' && !document.hidden)
      try {
        const answer = await query<T>(name, fields);
        if (live) {
          data.value = answer;
          why.value = '';
        }
      } catch (refused) {
        if (live) why.value = sentence(refused);
      }
    if (live) timer = setTimeout(() => void look(), every_ms);
  };
  void look();
  return () => {
    live = false;
    clearTimeout(timer);
  };
}

/** An empty `name` disables polling. */
export function usePoll<T>(name: string, fields: Fields, every_ms: number): Polled<T> {
  const data = useSignal<T | null>(null);
  const why = useSignal('');
  const key = JSON.stringify(fields);
  useEffect(() => {
    if (name === '') return undefined;
    return poll(name, JSON.parse(key) as Fields, every_ms, { data, why });
  }, [name, key, every_ms, data, why]);
  return { data, why };
}
