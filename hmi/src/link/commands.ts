// Commands and queries by name; shows the program's sentence for each rejection.
import { signal } from '@preact/signals';
import { Refusal, ROLES, type Fields, type Reply, type Role } from './contract';
import { ask, TOKEN_KEY } from './socket';
import * as state from './state';

export interface Notice {
  key: number;
  kind: 'refused' | 'done';
  text: string;
}

export const notices = signal<Notice[]>([]);
let key = 1;

export function notice(kind: Notice['kind'], text: string): void {
  const same = notices.peek().filter((one) => one.text !== text);
  const one = { key: key++, kind, text };
  notices.value = [...same, one].slice(-4);
  setTimeout(() => dismiss(one.key), kind === 'done' ? 4000 : 12000);
}

export function dismiss(which: number): void {
  notices.value = notices.peek().filter((one) => one.key !== which);
}

export function sentence(why: unknown): string {
  if (!(why instanceof Refusal)) return why instanceof Error ? why.message : String(why);
  const { line, column, message } = why.body;
  if (line === undefined || line <= 0) return message;
  return `Line ${line}${column === undefined || column <= 0 ? '' : `, column ${column}`}: ${message}`;
}

/** Sends a command. Returns false if it was rejected; the sentence is on the screen. */
export async function command(name: string, fields: Fields = {}): Promise<boolean> {
  return (await commandFor(name, fields)) !== null;
}

/** As command, with the answer; null if rejected. */
export async function commandFor(name: string, fields: Fields = {}): Promise<Reply | null> {
  try {
    return await ask({ ...fields, command: name });
  } catch (why) {
    notice('refused', sentence(why));
    return null;
  }
}

/** Sends a query. Throws Refusal. */
export const query = async <T>(name: string, fields: Fields = {}): Promise<T> =>
  (await ask({ ...fields, query: name })) as T;

/** Sends STOP over the stream and over HTTP. It needs neither token nor lease; a token identifies the user. */
export function stop(): void {
  ask({ command: 'stop' }).catch(() => undefined);
  const token = localStorage.getItem(TOKEN_KEY);
  const headers: Record<string, string> = token === null ? {} : { authorization: `Bearer ${token}` };
  fetch('api/stop', { method: 'POST', keepalive: true, headers }).then(
    (answer) => {
      if (!answer.ok)
        notice('refused', 'STOP did not reach the program by HTTP. If the machine moves, use its emergency stop.');
    },
    () =>
      notice(
        'refused',
        'STOP did not reach the program: the page is not connected. If the machine moves, use its emergency stop.',
      ),
  );
}

export function hasRole(needed: Role): boolean {
  return ROLES.indexOf(state.role.value) >= ROLES.indexOf(needed);
}

const standing = (): string => (state.role.value === 'none' ? 'are not paired' : `have the role ${state.role.value}`);

/** Reason why an action is not allowed now; empty: allowed. Reads signals, so that components update. */
export function whyNot(needed: Role, control = false): string {
  if (state.link.value !== 'open') return 'The page is not connected to the program.';
  if (!hasRole(needed))
    return `This needs the role ${needed}; you ${standing()}. Pair this browser with a code of that role.`;
  if (control && !state.inControl.value) {
    return state.holder.value !== '' ? `${state.holder.value} holds control.` : 'Take control first.';
  }
  return '';
}

export const mayOperate = (): string => whyNot('operate', true);
export const mayMaintain = (): string => whyNot('maintain', true);

/** Reason why the controller must not move: a card is in service; empty: none is. */
export function whyInService(): string {
  const card = state.status.value?.service ?? '';
  return card === '' ? '' : `Card ${card} is in service: nothing else drives the machine. End the service first.`;
}
