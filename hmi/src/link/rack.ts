// What does not change while the program runs: the rack's cards, registers, wires, faults. Asked once a connection.
import { computed, signal } from '@preact/signals';
import { query } from './commands';
import { whenOpen } from './socket';

export interface FieldInfo {
  name: string;
  low: number;
  bits: number;
  meaning: string;
}
export interface RegisterInfo {
  name: string;
  offset: number;
  width: number;
  access: string;
  bank?: string;
  per_axis?: boolean;
  meaning: string;
  fields: FieldInfo[];
}
export interface CommandInfo {
  name: string;
  code: number;
  meaning: string;
  /** Of the argument, from `least` to `greatest`; 0: it has none. */
  data_bytes: number;
  least: number;
  greatest: number;
  unit: string;
  /** Of the answer; 0: it has none. */
  answer_bytes: number;
}
export interface PinInfo {
  name: string;
  direction: string;
  volts: boolean;
  bits: number;
  meaning: string;
}
export interface StateMachine {
  name: string;
  meaning: string;
  states: { name: string; meaning: string }[];
  transitions: { from: string; to: string; when: string }[];
}
export interface CardInfo {
  name: string;
  type: string;
  title: string;
  slot: number;
  about: string;
  /** Where the real card is that stands for it; null: it is virtual. */
  live: string | null;
  /** `while_moving`: it only measures, and is accessed by hand at any time. */
  bus: { base: number; widths: number[]; while_moving: boolean };
  axes: { letter: string; channel: string }[];
  registers: RegisterInfo[];
  commands: CommandInfo[];
  machines: StateMachine[];
  pins: PinInfo[];
  values: string[];
  quantities: string[];
  /** Of its function library that can be called by hand; 0: there is none. */
  functions: number;
  channels: string[];
}
export interface RackInfo {
  name: string;
  axes: { letter: string; unit: string; card: string; channel: string }[];
  cards: CardInfo[];
  wires: { name: string; volts: boolean; bits: number; drivable: boolean }[];
  scanners: string[];
  /** Stages, belts, tables, scan heads. */
  parts: { name: string; kind: string; card: string | null }[];
  faults: { target: string; faults: string[] }[];
}
export interface ChannelInfo {
  name: string;
  unit: string;
  text: string;
}

export const rack = signal<RackInfo | null>(null);
export const channelList = signal<ChannelInfo[]>([]);
export const cardNamed = (name: string): CardInfo | undefined => rack.value?.cards.find((card) => card.name === name);
export const channelNames = computed(() => new Set(channelList.value.map((one) => one.name)));

async function load(): Promise<void> {
  try {
    rack.value = await query<RackInfo>('rack');
    channelList.value = (await query<{ channels: ChannelInfo[] }>('channels')).channels;
  } catch {
    // Panels say that they know no cards until the next connection.
  }
}
whenOpen(() => void load());
