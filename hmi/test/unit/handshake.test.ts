// The handshake of a DataBoard 4002, with a card that is busy after each byte.
import { describe, expect, test } from 'vitest';
import { ask, bytesOf, give, numberOf, type Bus } from '../../src/cards/handshake';
import type { CommandInfo } from '../../src/link/rack';

const command = (name: string, more: Partial<CommandInfo> = {}): CommandInfo => ({
  name,
  code: name.charCodeAt(0),
  meaning: '',
  data_bytes: 0,
  min: 0,
  max: 0,
  unit: '',
  answer_bytes: 0,
  ...more,
});

/** Busy for so many looks after each byte; what it was sent, and what it answers. */
function card(busyFor: number, answers: number[] = []): { bus: Bus; sent: string[]; rests: () => number } {
  const sent: string[] = [];
  let [busy, rests] = [0, 0];
  const work = <T>(result: T): T => {
    busy = busyFor;
    return result;
  };
  const bus: Bus = {
    choose: () => Promise.resolve(true),
    read: (port) => Promise.resolve(port === 'STAT' ? (busy === 0 ? 0x80 : 0) : work(answers.shift() ?? 0)),
    write: (port, byte) => {
      sent.push(`${port} ${byte}`);
      return Promise.resolve(work(busy === 0));
    },
    rest: () => {
      ++rests;
      busy = Math.max(0, busy - 1);
      return Promise.resolve();
    },
  };
  return { bus, sent, rests: () => rests };
}

describe('numbers', () => {
  test('are bytes with the lowest first, and back', () => {
    expect(bytesOf(-2, 3)).toEqual([0xfe, 0xff, 0xff]);
    expect(bytesOf(16_344, 2)).toEqual([0xd8, 0x3f]);
    for (const value of [0, 1, -1, 8_388_607, -8_388_608]) expect(numberOf(bytesOf(value, 3))).toBe(value);
    expect(numberOf([200])).toBe(200);
  });
});

describe('a command', () => {
  test('waits for Ready before each byte', async () => {
    const { bus, sent, rests } = card(3);
    expect(await give(bus, command('P', { data_bytes: 3 }), 1000)).toEqual({ value: null });
    expect(sent).toEqual(['C2 80', 'DATA 232', 'DATA 3', 'DATA 0']);
    expect(rests()).toBe(9);
  });

  test('is for the card that is chosen first', async () => {
    const { bus, sent } = card(0);
    const other = { ...bus, choose: () => bus.write('CS', 13) };
    await give(other, command('G'), 0);
    expect(sent).toEqual(['CS 13', 'C2 71']);
    expect(await ask({ ...bus, choose: () => Promise.resolve(false) }, command('V'))).toEqual({ why: '' });
  });

  test('without an argument is its letter', async () => {
    const { bus, sent } = card(0);
    await give(bus, command('G'), 0);
    expect(sent).toEqual(['C2 71']);
  });

  test('is answered with a number that has a sign', async () => {
    const { bus } = card(1, [0x9c, 0xff, 0xff]);
    expect(await ask(bus, command('P', { answer_bytes: 3 }))).toEqual({ value: -100 });
  });

  test('ends with a sentence where the card hangs', async () => {
    const { bus, sent } = card(1000);
    const hung = await give(bus, command('R', { data_bytes: 2 }), 5);
    expect('why' in hung && hung.why).toContain('Of 2 bytes of R it has 0.');
    expect(sent).toEqual(['C2 82']);
    const again = await ask(bus, command('V', { answer_bytes: 1 }));
    expect('why' in again && again.why).toContain('Nothing was sent.');
  });

  test('that is refused gives no second sentence', async () => {
    const bus: Bus = {
      choose: () => Promise.resolve(true),
      read: () => Promise.resolve(0x80),
      write: () => Promise.resolve(false),
      rest: () => Promise.resolve(),
    };
    expect(await give(bus, command('G'), 0)).toEqual({ why: '' });
  });
});
