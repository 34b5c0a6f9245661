// Scope settings: as typed, stored by this browser, and as the arming command.
import { signal } from '@preact/signals';
import type { Fields } from '../link/contract';
import { typed } from '../parts/numbers';

export const MAX_CHANNELS = 16;
const KEY = 'motionrack.scope';

/** Texts as typed. */
export interface Settings {
  channels: string[];
  /** A channel; empty: none. */
  trigger: string;
  edge: string;
  level: string;
  /** us */
  period: string;
  /** ms */
  length: string;
  /** ms */
  pre: string;
}

const EMPTY: Settings = {
  channels: [],
  trigger: '',
  edge: 'rise',
  level: '0.5',
  period: '100',
  length: '100',
  pre: '20',
};
export const settings = signal<Settings>({
  ...EMPTY,
  ...(JSON.parse(localStorage.getItem(KEY) ?? '{}') as Partial<Settings>),
});

export function set(part: Partial<Settings>): void {
  settings.value = { ...settings.value, ...part };
  localStorage.setItem(KEY, JSON.stringify(settings.value));
}

/** Fields of scope_arm; null if a level or a time is not a number. */
export function armFields(now: Settings, mode: 'run' | 'single'): Fields | null {
  const [level, period_us, length, pre] = [now.level, now.period, now.length, now.pre].map(typed);
  if (level == null || period_us == null || length == null || pre == null) return null;
  const trigger = now.trigger === '' ? {} : { trigger: now.trigger, edge: now.edge, level };
  return { channels: now.channels, ...trigger, period_us, length: length / 1000, pre: pre / 1000, mode };
}
