// The lease of a jog: started, renewed while a key is held, and ended by every event after which it may not be held.
import { describe, expect, test } from 'vitest';
import { after, settled, type Browser, type Settings } from './browser';
import { axis, connected, type Program } from './program';

type Lease = typeof import('../../src/jog/lease');
const HOLD = { 'motionrack.jog.step': '5' };
const AXES = [axis('X', { max_velocity: 50 }), axis('Y', { max_velocity: 20 }), axis('Z', { max_velocity: 10 })];

async function opened(settings: Settings = {}): Promise<{ browser: Browser; program: Program; lease: Lease }> {
  const { browser, program } = await connected({ stored: HOLD, ...settings, machine: { axes: AXES } });
  program.answers.jog = {};
  program.answers.jog_by = {};
  return { browser, program, lease: await import('../../src/jog/lease') };
}

const stops = (program: Program): number => program.asked('jog_stop').length;
const jogs = (program: Program): unknown[] => program.asked('jog').map(({ axis: letter, speed }) => [letter, speed]);

/** Expects that no further jog is sent within 500 ms. */
async function ended(program: Program): Promise<void> {
  const count = jogs(program).length;
  await after(500);
  expect(jogs(program)).toHaveLength(count);
}

describe('a held jog', () => {
  test('moves at once, and is renewed every 80 ms', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    expect(jogs(program)).toEqual([['X', 10]]);
    await after(79);
    expect(jogs(program)).toHaveLength(1);
    await after(1);
    expect(jogs(program)).toHaveLength(2);
    await after(800);
    expect(jogs(program)).toHaveLength(12);
  });

  test('uses the chosen share of the maximum velocity of the axis in both directions', async () => {
    const { lease, program } = await opened();
    lease.setSpeedPart(0.5);
    lease.begin('key', 'Y', -1);
    expect(jogs(program)).toEqual([['Y', -10]]);
  });

  test('uses the maximum velocity for a rapid jog until it is reduced', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1, true);
    await after(80);
    lease.slowDown();
    await after(80);
    expect(jogs(program)).toEqual([
      ['X', 50],
      ['X', 50],
      ['X', 10],
    ]);
  });

  test('stops once when the key is released', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    lease.end('key');
    lease.end('key');
    expect(stops(program)).toBe(1);
    await ended(program);
  });
});

describe('a jog', () => {
  test('is shown while it is held', async () => {
    const { lease } = await opened();
    lease.begin('a', 'X', 1);
    lease.begin('b', 'Y', -1);
    expect(lease.jogging.value).toBe('+X-Y');
    lease.endAll();
    expect(lease.jogging.value).toBe('');
  });

  test('is renewed no more often if it is begun again', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    lease.end('key');
    lease.begin('key', 'X', 1);
    await after(800);
    expect(jogs(program)).toHaveLength(12);
  });

  test('is not begun twice by the same key', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    lease.begin('key', 'Y', 1);
    expect(jogs(program)).toEqual([['X', 10]]);
  });

  test('is not sent for an axis that the machine does not have', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'B', 1);
    await after(200);
    expect([jogs(program), lease.jogging.value]).toEqual([[], '']);
  });

  test('is not requested again after the program rejected it', async () => {
    const { lease, program } = await opened();
    program.answers.jog = 'X stands at its limit.';
    lease.begin('key', 'X', 1);
    await settled();
    expect(lease.jogging.value).toBe('');
    expect(stops(program)).toBe(1);
    await ended(program);
  });
});

describe('the commands of a jog', () => {
  test('are numbered upwards, and only the first one can begin a motion', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    await after(160);
    lease.end('key');
    lease.begin('key', 'X', -1);
    const sent = program.asked('jog').map(({ sequence, renews }) => [sequence, renews]);
    expect(sent).toEqual([
      [1, undefined],
      [2, true],
      [3, true],
      [5, undefined],
    ]);
    expect(program.asked('jog_stop').map(({ sequence }) => sequence)).toEqual([4]);
  });

  test('end when a renewal is refused, until the key is pressed again', async () => {
    const { lease, program } = await opened();
    lease.begin('key', 'X', 1);
    await after(80);
    program.answers.jog = 'The jog of axis X has ended.';
    await after(80);
    expect(lease.jogging.value).toBe('');
    await ended(program);
    program.answers.jog = {};
    lease.begin('key', 'X', 1);
    expect(lease.jogging.value).toBe('+X');
  });

  test('continue for a second press after a late refusal of the first', async () => {
    const { lease, program } = await opened();
    program.answers.jog = 'X stands at its limit.';
    lease.begin('key', 'X', 1);
    lease.end('key');
    program.answers.jog = {};
    lease.begin('key', 'X', -1);
    await settled();
    expect(lease.jogging.value).toBe('-X');
  });
});

describe('two held jogs', () => {
  test('stop alone: releasing one key stops its axis only', async () => {
    const { lease, program } = await opened();
    lease.begin('a', 'X', 1);
    lease.begin('b', 'Y', 1);
    lease.end('a');
    expect(jogs(program).at(-1)).toEqual(['X', 0]);
    expect(stops(program)).toBe(0);
    await after(80);
    expect(jogs(program).at(-1)).toEqual(['Y', 4]);
    lease.end('b');
    expect(stops(program)).toBe(1);
  });

  test('of one axis follow the later key, and releasing the earlier one changes nothing', async () => {
    const { lease, program } = await opened();
    lease.begin('a', 'X', 1);
    lease.begin('b', 'X', -1);
    lease.end('a');
    await after(80);
    expect(jogs(program)).toEqual([
      ['X', 10],
      ['X', -10],
      ['X', -10],
    ]);
    expect(stops(program)).toBe(0);
  });
});

describe('a jog ends', () => {
  const ends: [string, (browser: Browser, lease: Lease) => void][] = [
    ['the window loses the focus', (browser) => browser.window.dispatchEvent(new Event('blur'))],
    ['the page is left', (browser) => browser.window.dispatchEvent(new Event('pagehide'))],
    ['the page is hidden', (browser) => browser.hide(true)],
    ['the keyboard is disarmed', (_, lease) => lease.setArmed(false)],
    ['another step is chosen', (_, lease) => lease.setStep(0)],
    ['the connection is lost', (browser) => browser.socket.close()],
  ];
  test.each(ends)('when %s', async (_, happens) => {
    const { browser, lease, program } = await opened();
    lease.setArmed(true);
    lease.begin('key', 'X', 1);
    happens(browser, lease);
    expect(lease.jogging.value).toBe('');
    await ended(program);
  });

  test('with a stop command, if the page is connected', async () => {
    const { browser, lease, program } = await opened();
    lease.begin('key', 'X', 1);
    browser.hide(true);
    expect(stops(program)).toBe(1);
  });

  test('only if one is active, and not when the page is shown', async () => {
    const { browser, lease, program } = await opened();
    browser.window.dispatchEvent(new Event('blur'));
    lease.begin('key', 'X', 1);
    browser.hide(false);
    await after(80);
    expect([jogs(program).length, stops(program)]).toEqual([2, 0]);
  });
});

describe('a step', () => {
  test('is one move per press, however long the key is held', async () => {
    const { lease, program } = await opened({ stored: { 'motionrack.jog.step': '2' } });
    lease.begin('key', 'X', -1);
    await after(1000);
    lease.end('key');
    expect(program.asked('jog_by')).toEqual([{ command: 'jog_by', axis: 'X', distance: -0.1, speed: 10 }]);
    expect([jogs(program), stops(program)]).toEqual([[], 0]);
  });
});

describe('the settings of jogging', () => {
  test('are kept', async () => {
    const { browser, lease } = await opened();
    lease.setStep(1);
    lease.setSpeedPart(0.05);
    const again = await opened({ stored: Object.fromEntries(browser.store) });
    expect([again.lease.stepIndex.value, again.lease.speedPart.value]).toEqual([1, 0.05]);
  });

  test.each(['9', '-1', 'x'])('are a step of 1 and a fifth of the speed where "%s" was kept', async (kept) => {
    const { lease } = await opened({ stored: { 'motionrack.jog.step': kept, 'motionrack.jog.speed': 'x' } });
    expect([lease.STEPS[lease.stepIndex.value], lease.speedPart.value]).toEqual([1, 0.2]);
  });
});
