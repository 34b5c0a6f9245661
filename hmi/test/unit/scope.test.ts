// The scope without its chart: arming, recordings, cursors, the search for channels.
import { beforeEach, describe, expect, test } from 'vitest';
import type { Settings } from '../../src/scope/settings';
import { csv, nearest, thirds, valueAt } from '../../src/scope/reading';
import { matching } from '../../src/scope/matching';
import { openBrowser, type Browser } from './browser';
import { connected } from './program';

const ROWS = [
  [-10, 0, 10, 20],
  [null, 1, null, 3],
  [5, null, null, null],
];

describe('the scope’s table and cursors', () => {
  test('keep the last value of a channel that did not change', () => {
    expect([0, 1, 2, 3].map((i) => valueAt(ROWS[1] ?? [], i))).toEqual([null, 1, 1, 3]);
    expect(valueAt(ROWS[2] ?? [], 3)).toBe(5);
  });

  test('have no value for a channel without values', () => expect(valueAt([], 2)).toBeNull());

  test('snap to the nearest time', () => {
    expect(nearest([-10, 0, 10], -99)).toBe(0);
    expect(nearest([-10, 0, 10], 4.9)).toBe(1);
    expect(nearest([-10, 0, 10], 5.1)).toBe(2);
    expect(nearest([], 3)).toBe(0);
  });

  test('begin at one third and two thirds', () => {
    expect(thirds([0, 1, 2, 3, 4, 5])).toEqual([2, 4]);
    expect(thirds([0, 1, 2])).toBeNull();
  });

  test('have a head, a row per time, and empty cells without a change', () => {
    expect(csv(['X.error', 'limit'], ROWS)).toBe('time_ms,X.error,limit\n-10,,5\n0,1,\n10,,\n20,3,\n');
  });

  test('have only a head without samples', () => expect(csv([], [])).toBe('time_ms\n'));
});

describe('the search for channels', () => {
  const all = [
    { name: 'X.error', unit: 'mm', text: 'following error of the axis' },
    { name: 'Y.error', unit: 'mm', text: 'following error of the axis' },
    { name: 'limit.x', unit: '', text: 'the limit switch' },
  ];
  const found = (text: string, chosen: string[] = []): string[] => matching(all, chosen, text).map((one) => one.name);

  test('finds a channel by a part of its name, in any case', () =>
    expect(found('ERR')).toEqual(['X.error', 'Y.error']));

  test('finds all without a text', () => expect(found('')).toHaveLength(3));

  test('includes the meaning from four letters on', () => {
    expect(found('swi')).toEqual([]);
    expect(found('swit')).toEqual(['limit.x']);
  });

  test('omits channels that are chosen already', () => expect(found('error', ['X.error'])).toEqual(['Y.error']));
});

describe('arming', () => {
  const now: Settings = {
    channels: ['X.error', 'limit.x'],
    trigger: 'limit.x',
    edge: 'fall',
    level: '0,5',
    period: '50',
    length: '200',
    pre: '20',
  };
  let armFields: (typeof import('../../src/scope/settings'))['armFields'];
  beforeEach(async () => {
    openBrowser();
    ({ armFields } = await import('../../src/scope/settings'));
  });

  test('sends the period in us, and lengths in seconds', () => {
    expect(armFields(now, 'single')).toEqual({
      channels: ['X.error', 'limit.x'],
      trigger: 'limit.x',
      edge: 'fall',
      level: 0.5,
      period_us: 50,
      length: 0.2,
      pre: 0.02,
      mode: 'single',
    });
  });

  test('sends no edge and no level without a trigger', () => {
    expect(armFields({ ...now, trigger: '' }, 'run')).toEqual({
      channels: ['X.error', 'limit.x'],
      period_us: 50,
      length: 0.2,
      pre: 0.02,
      mode: 'run',
    });
  });

  test.each(['level', 'period', 'length', 'pre'] as const)('is refused if the %s is not a number', (field) => {
    expect(armFields({ ...now, [field]: 'soon' }, 'run')).toBeNull();
    expect(armFields({ ...now, [field]: '' }, 'run')).toBeNull();
  });
});

describe('settings of the scope', () => {
  const opened = async (
    stored?: Record<string, string>,
  ): Promise<[Browser, typeof import('../../src/scope/settings')]> => [
    openBrowser({ ...(stored && { stored }) }),
    await import('../../src/scope/settings'),
  ];

  test('are kept by the browser', async () => {
    const [browser, { set }] = await opened();
    set({ channels: ['X.error'], level: '2' });
    const [, { settings }] = await opened(Object.fromEntries(browser.store));
    expect(settings.value).toMatchObject({ channels: ['X.error'], level: '2', edge: 'rise' });
  });

  test('have their default value if an older page lacked them', async () => {
    const [, { settings }] = await opened({ 'motionrack.scope': '{"length":"5"}' });
    expect(settings.value).toMatchObject({ length: '5', pre: '20', channels: [] });
  });
});

const samples = { name: 'X.error', unit: 'mm', edges: false, values: [1, 2, null] };
const edges = { name: 'limit.x', unit: '', edges: true, values: [1, 0], at: [0.005, 0.015], before: 0 };
const capture = { number: 3, trigger_at: 9, from: -0.01, to: 0.02, period: 0.01, first_sample: 0, full: true };
const recorder = async (): Promise<typeof import('../../src/scope/recorded')> => {
  openBrowser();
  return import('../../src/scope/recorded');
};

describe('the samples of a recording', () => {
  test('are equidistant, in milliseconds from the trigger', async () => {
    const { keep, recorded } = await recorder();
    keep({ state: 'done', capture: { ...capture, traces: [samples] } });
    expect(recorded.value).toEqual({
      number: 3,
      names: ['X.error'],
      stepped: [],
      rows: [
        [0, 10, 20],
        [1, 2, null],
      ],
    });
  });

  test('begin with the level before them, and end with the last one', async () => {
    const { keep, recorded } = await recorder();
    keep({ state: 'done', capture: { ...capture, traces: [edges] } });
    expect(recorded.value.stepped).toEqual(['limit.x']);
    expect(recorded.value.rows).toEqual([
      [-10, 5, 15, 20],
      [0, 1, 0, 0],
    ]);
  });

  test('are one line for a wire that did not change', async () => {
    const { keep, recorded } = await recorder();
    keep({ state: 'done', capture: { ...capture, traces: [{ ...edges, values: [], at: [], before: 1 }] } });
    expect(recorded.value.rows).toEqual([
      [-10, 20],
      [1, 1],
    ]);
  });

  test('share one list of times for both kinds of channels', async () => {
    const { keep, recorded } = await recorder();
    keep({ state: 'done', capture: { ...capture, traces: [samples, edges] } });
    expect(recorded.value.rows).toEqual([
      [-10, 0, 5, 10, 15, 20],
      [null, 1, null, 2, null, null],
      [0, null, 1, null, 0, 0],
    ]);
  });
});

describe('a recording', () => {
  test('stays if an answer has no new one', async () => {
    const { keep, recorded } = await recorder();
    keep({ state: 'done', capture: { ...capture, traces: [samples] } });
    const kept = recorded.value;
    keep({ state: 'armed', capture: null });
    keep({ state: 'done' });
    keep({ state: 'done', capture: { ...capture, traces: [edges] } });
    expect(recorded.value).toBe(kept);
  });

  test('is discarded after a restart of the program, and outlasts a lost connection', async () => {
    const { program } = await connected();
    const { keep, recorded } = await import('../../src/scope/recorded');
    keep({ state: 'done', capture: { ...capture, traces: [samples] } });
    program.greet();
    expect(recorded.value.number).toBe(3);
    program.greet({ boot: 'second' });
    expect(recorded.value).toEqual({ number: 0, names: [], stepped: [], rows: [] });
  });
});
