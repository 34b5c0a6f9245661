// The handshake of a DataBoard 4002, with a card that is busy after each byte.
import { describe, expect, test } from 'vitest';
import { ask, bytesOf, choose, give, numberOf, Turns, type Bus, type Shown } from '../../src/cards/handshake';
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

describe('an empty bus', () => {
  /** Answers FFh once `answered` bytes were written. */
  const leaving = (answered: number): { bus: Bus; sent: string[] } => {
    const sent: string[] = [];
    const bus: Bus = {
      choose: () => Promise.resolve(true),
      read: (port) => Promise.resolve(sent.length < answered && port === 'STAT' ? 0x80 : 0xff),
      write: (port, byte) => {
        sent.push(`${port} ${byte}`);
        return Promise.resolve(true);
      },
      rest: () => Promise.reject(new Error('It is not waited for.')),
    };
    return { bus, sent };
  };

  test('is not taken for a card that is ready: nothing is sent', async () => {
    const { bus, sent } = leaving(0);
    const why = 'No card answers (STAT reads FFh). Nothing was sent.';
    expect(await give(bus, command('G'), 0)).toMatchObject({ why: expect.stringContaining(why) as string });
    expect(await ask(bus, command('V', { answer_bytes: 1 }))).toMatchObject({
      why: expect.stringContaining(why) as string,
    });
    expect(sent).toEqual([]);
  });

  test('in the middle of a command ends it with the bytes that were sent', async () => {
    const { bus, sent } = leaving(2);
    expect(await give(bus, command('P', { data_bytes: 3 }), 1)).toMatchObject({
      why: expect.stringContaining('Of 3 bytes of P it has 1.') as string,
    });
    expect(sent).toEqual(['C2 80', 'DATA 1']);
  });

  test('gives no answer', async () => {
    const { bus } = leaving(1);
    expect(await ask(bus, command('P', { answer_bytes: 3 }))).toMatchObject({
      why: expect.stringContaining('Of 3 bytes of P 0 were read.') as string,
    });
  });
});

describe('the card', () => {
  const writes = (): { written: string[]; write: (port: string, byte: number) => Promise<boolean> } => {
    const written: string[] = [];
    return {
      written,
      write: (port, byte) => {
        written.push(`${port} ${byte}`);
        return Promise.resolve(true);
      },
    };
  };
  const shown = (csb: number, select: number | null): Promise<Shown> => Promise.resolve({ csb, select });

  test('is selected by its reported number unless already selected', async () => {
    const { written, write } = writes();
    expect(await choose(() => shown(1, 13), write)).toBe(true);
    expect(written).toEqual([]);
    expect(await choose(() => shown(0, 13), write)).toBe(true);
    expect(written).toEqual(['CS 13']);
  });

  test('is not selected before its number is known', async () => {
    const { written, write } = writes();
    expect(await choose(() => Promise.resolve(null), write)).toBe(false);
    expect(await choose(() => shown(0, null), write)).toBe(false);
    expect(written).toEqual([]);
  });

  test('is queried each time for its CSB', async () => {
    const { written, write } = writes();
    const answers: (Shown | null)[] = [
      { csb: 1, select: 13 },
      { csb: 0, select: 13 },
    ];
    const look = (): Promise<Shown | null> => Promise.resolve(answers.shift() ?? null);
    expect([await choose(look, write), await choose(look, write), await choose(look, write)]).toEqual([
      true,
      true,
      false,
    ]);
    expect(written).toEqual(['CS 13']);
  });
});

describe('two exchanges that overlap', () => {
  test('do not mix their bytes', async () => {
    const { bus, sent } = card(1);
    const turns = new Turns();
    const position = turns.take(() => give(bus, command('P', { data_bytes: 2 }), 1000));
    const go = turns.take(() => give(bus, command('G'), 0));
    expect(await Promise.all([position, go])).toEqual([{ value: null }, { value: null }]);
    expect(sent).toEqual(['C2 80', 'DATA 232', 'DATA 3', 'C2 71']);
  });

  test('do not wait for one that failed', async () => {
    const { bus, sent } = card(0);
    const turns = new Turns();
    const failed = turns.take(() => Promise.reject(new Error('The link is gone.')));
    const go = turns.take(() => give(bus, command('G'), 0));
    await expect(failed).rejects.toThrow('The link is gone.');
    expect(await go).toEqual({ value: null });
    expect(sent).toEqual(['C2 71']);
  });
});
