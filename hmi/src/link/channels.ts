// Channels of the stream: panels register their channels; one subscription covers all of them.
import { signal, type Signal } from '@preact/signals';
import { ask, PERIOD_HZ, whenOpen, whenPicture } from './socket';

interface Wish {
  channels: string[];
  rate: number;
}

const MOST = 64;
const wishes = new Set<Wish>();
const values = new Map<string, Signal<number | null>>();
let order: string[] = [];
let planned = false;

/** Newest value of a channel; null before the first one. */
export function channel(name: string): Signal<number | null> {
  let one = values.get(name);
  if (one === undefined) values.set(name, (one = signal<number | null>(null)));
  return one;
}

/** Subscribes until the returned function is called. `rate` in snapshots per second. */
export function want(channels: string[], rate = PERIOD_HZ): () => void {
  const wish = { channels, rate };
  wishes.add(wish);
  plan();
  return () => {
    wishes.delete(wish);
    plan();
  };
}

function plan(): void {
  if (planned) return;
  planned = true;
  queueMicrotask(() => {
    planned = false;
    void subscribe();
  });
}

async function subscribe(): Promise<void> {
  const all = [...new Set([...wishes].flatMap((wish) => wish.channels))].slice(0, MOST);
  const rate = Math.max(PERIOD_HZ, ...[...wishes].map((wish) => wish.rate));
  try {
    await ask({ subscribe: { channels: all, rate_hz: rate } });
    order = all;
  } catch {
    order = [];
  }
}

whenOpen(() => void subscribe());
whenPicture((picture) => {
  if (picture.values?.length !== order.length) return;
  order.forEach((name, i) => (channel(name).value = picture.values?.[i] ?? null));
});
