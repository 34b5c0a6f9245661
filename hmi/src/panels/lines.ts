// MDI lines: the draft, the log with its answers, and the history.
import { signal } from '@preact/signals';
import { sentence } from '../link/commands';
import { ask } from '../link/socket';

interface Sent {
  text: string;
  answer: string;
  good: boolean;
}

const KEY = 'motionrack.mdi';
const KEPT = 100;
export const log = signal<Sent[]>([]);
/** Newest first. */
const history = signal<string[]>(JSON.parse(localStorage.getItem(KEY) ?? '[]') as string[]);
export const draft = signal('');
/** Index of the history line in the draft; -1: none. */
const place = signal(-1);

export async function send(): Promise<void> {
  const text = draft.value.trim();
  if (text === '') return;
  draft.value = '';
  place.value = -1;
  history.value = [text, ...history.value.filter((one) => one !== text)].slice(0, KEPT);
  localStorage.setItem(KEY, JSON.stringify(history.value));
  const one: Sent = { text, answer: '…', good: true };
  log.value = [...log.value, one].slice(-KEPT);
  const answer = await ask({ command: 'mdi', text }).then(
    () => ({ answer: 'ok', good: true }),
    (why: unknown) => ({ answer: sentence(why), good: false }),
  );
  log.value = log.value.map((other) => (other === one ? { ...one, ...answer } : other));
}

/** Goes back (1) or forward (-1) in the history, down to an empty line. */
export function walk(by: number): void {
  const next = Math.min(history.value.length - 1, Math.max(-1, place.value + by));
  place.value = next;
  draft.value = next < 0 ? '' : (history.value[next] ?? '');
}
