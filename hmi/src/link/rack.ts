// Constant data of the rack: cards, registers, wires, faults. Queried once per connection.
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
  /** Bytes of the argument, from `min` to `max`; 0: none. */
  data_bytes: number;
  min: number;
  max: number;
  unit: string;
  /** Bytes of the answer; 0: none. */
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
  /** Address of the real card behind it; null: virtual. */
  live: string | null;
  /** `while_moving`: the card only measures and allows manual access at any time. */
  bus: { base: number; widths: number[]; while_moving: boolean };
  axes: { letter: string; channel: string }[];
  registers: RegisterInfo[];
  commands: CommandInfo[];
  machines: StateMachine[];
  pins: PinInfo[];
  values: string[];
  quantities: string[];
  /** Number of library functions that can be called manually; 0: none. */
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
    // Until the next connection, panels report that no cards are known.
  }
}
whenOpen(() => void load());
