// Handshake of a DataBoard 4002: each byte to C2 and DATA, and each from DATA, requires Ready in STAT. A command is a
// letter at C2, followed by its argument bytes at DATA, least significant first, or by its answer bytes from DATA.
import type { CommandInfo } from '../link/rack';

/** Ports of the card. */
export interface Bus {
  /** Selects this card on the bus. Returns false if rejected. */
  choose(): Promise<boolean>;
  /** Returns the byte at a port; null if rejected. */
  read(port: string): Promise<number | null>;
  /** Returns false if rejected. */
  write(port: string, byte: number): Promise<boolean>;
  /** Gives the card time to work. */
  rest(): Promise<void>;
}

export type Exchanged = { value: number | null } | { why: string };

const READY = 0x80;
const LOOKS = 40;
const refused: Exchanged = { why: '' };
const late = (sent: string): Exchanged => ({
  why: `The card was not ready after ${LOOKS} reads of STAT. ${sent} Check whether its program hangs, or reset it.`,
});

async function ready(bus: Bus): Promise<boolean | null> {
  for (let look = 0; look < LOOKS; ++look) {
    const status = await bus.read('STAT');
    if (status === null) return null;
    if ((status & READY) !== 0) return true;
    await bus.rest();
  }
  return false;
}

/** Bytes of a number, least significant first; negative numbers as two's complement. */
export const bytesOf = (value: number, count: number): number[] =>
  [...Array(count).keys()].map((byte) => Math.floor(value / 2 ** (8 * byte)) & 0xff);

/** Number of these bytes; signed if there is more than one. */
export function numberOf(bytes: readonly number[]): number {
  const value = bytes.reduceRight((sum, byte) => sum * 256 + byte, 0);
  const range = 256 ** bytes.length;
  return bytes.length > 1 && value >= range / 2 ? value - range : value;
}

async function begin(bus: Bus, command: CommandInfo): Promise<Exchanged | null> {
  if (!(await bus.choose())) return refused;
  const state = await ready(bus);
  if (state === null) return refused;
  if (!state) return late('Nothing was sent.');
  return (await bus.write('C2', command.code)) ? null : refused;
}

/** Sends a command with its argument, if any. */
export async function give(bus: Bus, command: CommandInfo, argument: number): Promise<Exchanged> {
  const wrong = await begin(bus, command);
  if (wrong !== null) return wrong;
  const bytes = bytesOf(argument, command.data_bytes);
  for (const [sent, byte] of bytes.entries()) {
    const state = await ready(bus);
    if (state === false) return late(`Of ${bytes.length} bytes of ${command.name} it has ${sent}.`);
    if (state === null || !(await bus.write('DATA', byte))) return refused;
  }
  return { value: null };
}

/** Sends a command and reads its answer. */
export async function ask(bus: Bus, command: CommandInfo): Promise<Exchanged> {
  const wrong = await begin(bus, command);
  if (wrong !== null) return wrong;
  const bytes: number[] = [];
  while (bytes.length < command.answer_bytes) {
    const state = await ready(bus);
    if (state === false) return late(`Of ${command.answer_bytes} bytes of ${command.name} ${bytes.length} were read.`);
    const byte = state === null ? null : await bus.read('DATA');
    if (byte === null) return refused;
    bytes.push(byte);
  }
  return { value: numberOf(bytes) };
}
