// Repeated queries of panels, and the last seconds of channels.
import { signal } from '@preact/signals';
import { describe, expect, test } from 'vitest';
import { after, settled, type Browser } from './browser';
import { connected, type Program } from './program';

interface Answer {
  word: number;
}
type Polled = import('../../src/parts/poll').Polled<Answer>;

async function polling(): Promise<{ browser: Browser; program: Program; polled: Polled; stop: () => void }> {
  const { browser, program } = await connected();
  const polled: Polled = { data: signal(null), why: signal('') };
  const { poll } = await import('../../src/parts/poll');
  return { browser, program, polled, stop: poll('card', { name: 'mcx' }, 250, polled) };
}

describe('a query of a panel', () => {
  test('is sent at once, and again an interval after each answer', async () => {
    const { polled, program } = await polling();
    expect(program.asked('card')).toEqual([{ query: 'card', name: 'mcx' }]);
    program.answers.card = { word: 7 };
    program.say({ id: program.heard.at(-1)?.id, word: 6 });
    await settled();
    expect(polled.data.value).toMatchObject({ word: 6 });
    await after(249);
    expect(program.asked('card')).toHaveLength(1);
    await after(1);
    expect(polled.data.value).toMatchObject({ word: 7 });
  });

  test('is not sent again before its answer', async () => {
    const { program } = await polling();
    for (let i = 0; i < 8; ++i) {
      program.show();
      await after(250);
    }
    expect(program.asked('card')).toHaveLength(1);
  });

  test('reports a refusal, keeps its last data and is repeated', async () => {
    const { polled, program } = await polling();
    program.say({ id: program.heard.at(-1)?.id, word: 6 });
    program.answers.card = 'Unknown card mcx.';
    await after(250);
    expect([polled.data.value, polled.why.value]).toMatchObject([{ word: 6 }, 'Unknown card mcx.']);
    program.answers.card = { word: 8 };
    await after(250);
    expect([polled.data.value, polled.why.value]).toMatchObject([{ word: 8 }, '']);
  });

  test('is not sent while the page is hidden', async () => {
    const { browser, program } = await polling();
    program.answers.card = { word: 7 };
    program.say({ id: program.heard.at(-1)?.id, word: 6 });
    browser.hide(true);
    await after(1000);
    expect(program.asked('card')).toHaveLength(1);
    browser.hide(false);
    await after(250);
    expect(program.asked('card')).toHaveLength(2);
  });

  test('ends with its panel: a later answer is not shown, and no query follows', async () => {
    const { polled, program, stop } = await polling();
    stop();
    program.say({ id: program.heard.at(-1)?.id, word: 6 });
    await after(1000);
    expect([polled.data.value, program.asked('card').length]).toEqual([null, 1]);
  });
});

describe('the last seconds of channels', () => {
  const recording = async (): Promise<{ data: { value: (number | null)[][] }; program: Program; stop: () => void }> => {
    const { program } = await connected();
    const data = signal<(number | null)[][]>([[], [], []]);
    const { record } = await import('../../src/cards/history');
    const stop = record(['mcx.CV', 'mcx.LP'], 100, 10, data);
    await settled();
    return { data, program, stop };
  };
  /** Sends a snapshot with this machine time, after a delay that is long enough for a chart to be redrawn. */
  const next = async (program: Program, at: number, values: (number | null)[]): Promise<void> => {
    await after(60);
    program.show({ at }, values);
  };

  test('are requested at their rate', async () => {
    const { program } = await recording();
    expect(program.asked('subscribe').at(-1)).toEqual({
      subscribe: { channels: ['mcx.CV', 'mcx.LP'], rate_hz: 100 },
    });
  });

  test('are given in seconds before now, one row per channel', async () => {
    const { data, program } = await recording();
    await next(program, 5, [1, 10]);
    await next(program, 6, [2, null]);
    expect(data.value).toEqual([
      [-1, 0],
      [1, 2],
      [10, null],
    ]);
  });

  test('are dropped when they are too old', async () => {
    const { data, program } = await recording();
    for (const at of [1, 5, 11, 13, 14]) await next(program, at, [at, 0]);
    expect(data.value[0]).toEqual([-9, -3, -1, 0]);
  });

  test('are drawn 20 times a second at most, with every sample', async () => {
    const { data, program } = await recording();
    await next(program, 1, [1, 0]);
    program.show({ at: 2 }, [2, 0]);
    expect(data.value[1]).toEqual([1]);
    await next(program, 3, [3, 0]);
    expect(data.value[1]).toEqual([1, 2, 3]);
  });

  test('end with their chart', async () => {
    const { data, program, stop } = await recording();
    await next(program, 1, [1, 0]);
    stop();
    await next(program, 2, [2, 0]);
    expect(data.value[1]).toEqual([1]);
    await settled();
    expect(program.asked('subscribe').at(-1)).toEqual({ subscribe: { channels: [], rate_hz: 20 } });
  });
});
