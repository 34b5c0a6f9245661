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

/** The card as it answers now. */
export interface Shown {
  /** 1 while the host addresses the card. */
  csb: number | undefined;
  /** Number under which it is addressed. */
  select: number | null;
}

/** Selects the card unless it is selected. `look` asks the card itself, since an earlier answer may be outdated. */
export async function choose(
  look: () => Promise<Shown | null>,
  write: (port: string, byte: number) => Promise<boolean>,
): Promise<boolean> {
  const shown = await look();
  const select = shown?.select ?? null;
  if (select === null) return false;
  return shown?.csb === 1 || (await write('CS', select));
}

export type Exchanged = { value: number | null } | { why: string };

const READY = 0x80;
/** STAT where no card answers; the function library takes it so too. */
const NO_CARD = 0xff;
const LOOKS = 40;
const refused: Exchanged = { why: '' };
const late = (sent: string): Exchanged => ({
  why: `The card was not ready after ${LOOKS} reads of STAT. ${sent} Check whether its program hangs, or reset it.`,
});
const absent = (sent: string): Exchanged => ({
  why: `No card answers (STAT reads FFh). ${sent} Check the card's number and its supply.`,
});

/** Waits for Ready. Returns null when the next byte may follow. `sent` says how far the command came. */
async function waitReady(bus: Bus, sent: string): Promise<Exchanged | null> {
  for (let look = 0; look < LOOKS; ++look) {
    const status = await bus.read('STAT');
    if (status === null) return refused;
    if (status === NO_CARD) return absent(sent);
    if ((status & READY) !== 0) return null;
    await bus.rest();
  }
  return late(sent);
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
  const wrong = await waitReady(bus, 'Nothing was sent.');
  if (wrong !== null) return wrong;
  return (await bus.write('C2', command.code)) ? null : refused;
}

/** Sends a command with its argument, if any. */
export async function give(bus: Bus, command: CommandInfo, argument: number): Promise<Exchanged> {
  const wrong = await begin(bus, command);
  if (wrong !== null) return wrong;
  const bytes = bytesOf(argument, command.data_bytes);
  for (const [sent, byte] of bytes.entries()) {
    const stopped = await waitReady(bus, `Of ${bytes.length} bytes of ${command.name} it has ${sent}.`);
    if (stopped !== null) return stopped;
    if (!(await bus.write('DATA', byte))) return refused;
  }
  return { value: null };
}

/** Sends a command and reads its answer. */
export async function ask(bus: Bus, command: CommandInfo): Promise<Exchanged> {
  const wrong = await begin(bus, command);
  if (wrong !== null) return wrong;
  const bytes: number[] = [];
  while (bytes.length < command.answer_bytes) {
    const read = `Of ${command.answer_bytes} bytes of ${command.name} ${bytes.length} were read.`;
    const stopped = await waitReady(bus, read);
    if (stopped !== null) return stopped;
    const byte = await bus.read('DATA');
    if (byte === null) return refused;
    bytes.push(byte);
  }
  return { value: numberOf(bytes) };
}

/** Runs exchanges with a card one after the other: it would take the bytes of two that overlap for those of one. */
export class Turns {
  private last: Promise<unknown> = Promise.resolve();

  take<T>(exchange: () => Promise<T>): Promise<T> {
    const next = this.last.then(exchange, exchange);
    this.last = next;
    return next;
  }
}
