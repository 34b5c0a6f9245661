// Machine state on the page: states, control, alarms, age.
import { describe, expect, test } from 'vitest';
import { alarmState } from '../../src/link/alarms';
import type { Alarm } from '../../src/link/contract';
import { after, openBrowser } from './browser';
import { axis, connected } from './program';

const state = async (): Promise<typeof import('../../src/link/state')> => import('../../src/link/state');
const alarm = (part: Partial<Alarm>): Alarm => ({
  number: 1,
  at: 0,
  text: 'limit',
  active: true,
  acknowledged: false,
  ...part,
});

describe('the machine', () => {
  test('is disabled until its state is known', async () => {
    openBrowser();
    const { axes, holder, inControl, machineState } = await state();
    expect([machineState.value, axes.value, holder.value, inControl.value]).toEqual(['disabled', [], '', false]);
  });

  test('shows states with blanks, in any spelling', async () => {
    openBrowser();
    expect((await state()).stateName('error_stop')).toBe('error stop');
  });

  test.each([
    ['standstill', true],
    ['disabled', true],
    ['error_stop', true],
    ['moving', false],
    ['hold', false],
    ['homing', false],
    ['jogging', false],
    ['stopping', false],
  ])('in the state %s stands still: %s', async (name, stands) => {
    await connected({ machine: { state: name } });
    expect((await state()).standsStill.value).toBe(stands);
  });

  test('has axes by their letters', async () => {
    await connected({ machine: { axes: [axis('X'), axis('C', { max: 360 })] } });
    const { axisLetters, axisOf } = await state();
    expect(axisLetters.value).toBe('XC');
    expect(axisOf('C')?.max).toBe(360);
    expect(axisOf('Y')).toBeUndefined();
  });
});

describe('control', () => {
  test('belongs to this tab only if its own session holds it', async () => {
    const { program } = await connected({ machine: { control: { holder: 'anna', holder_session: 'this tab' } } });
    const { inControl } = await state();
    expect(inControl.value).toBe(true);
    program.show({ state: 'hold', control: { holder: 'anna', holder_session: 'another tab' } });
    expect(inControl.value).toBe(false);
  });

  test('does not belong to this tab if the program reports no sessions', async () => {
    await connected({ greeting: { session: undefined }, machine: { control: { holder: 'anna' } } });
    expect((await state()).inControl.value).toBe(false);
  });

  test('has a holder with a name, or another browser, or none', async () => {
    const { program } = await connected({ machine: { control: { holder: 'bert' } } });
    const { holder } = await state();
    expect(holder.value).toBe('bert');
    program.show({ state: 'hold', control: { holder: '' } });
    expect(holder.value).toBe('another browser');
    program.show({ state: 'moving', control: { holder: null } });
    expect(holder.value).toBe('');
  });
});

describe('alarms', () => {
  test('are open while they are active or not acknowledged', async () => {
    await connected({
      machine: {
        alarms: [
          alarm({ number: 1 }),
          alarm({ number: 2, acknowledged: true }),
          alarm({ number: 3, active: false }),
          alarm({ number: 4, active: false, acknowledged: true }),
        ],
      },
    });
    expect((await state()).openAlarms.value.map((one) => one.number)).toEqual([1, 2, 3]);
  });

  test.each([
    [true, false, 'active, unacknowledged', 'alarm'],
    [true, true, 'active, acknowledged', 'attention'],
    [false, false, 'returned, unacknowledged', 'attention'],
    [false, true, 'over', 'calm'],
  ])('show active %s and acknowledged %s as: %s', (active, acknowledged, word, tone) => {
    expect(alarmState(alarm({ active, acknowledged }))).toEqual({ word, tone });
  });
});

describe('the age of the status', () => {
  test('is infinite before the first status message', async () => {
    openBrowser();
    const { age, ageText, stale } = await state();
    await after(1000);
    expect([age.value, stale.value, ageText(age.value)]).toEqual([Infinity, true, '']);
  });

  test('marks it as stale from 500 ms on, until a new status message', async () => {
    const { program } = await connected();
    const { stale } = await state();
    program.show();
    await after(400);
    expect(stale.value).toBe(false);
    await after(200);
    expect(stale.value).toBe(true);
    program.show();
    expect(stale.value).toBe(false);
  });

  test('marks it as stale at once if the connection is lost', async () => {
    const { browser } = await connected();
    browser.socket.close();
    expect((await state()).stale.value).toBe(true);
  });

  test('greys the page', async () => {
    const { browser } = await connected();
    await after(600);
    expect(browser.document.documentElement.classList.toggle).toHaveBeenLastCalledWith('stale', true);
  });

  test.each([
    [0, '< 100 ms'],
    [50, '< 100 ms'],
    [100, '< 200 ms'],
    [450, '< 500 ms'],
    [500, '0.5 s old'],
    [2345, '2.3 s old'],
  ])('of %d ms is written %s', async (ms, text) => {
    openBrowser();
    expect((await state()).ageText(ms)).toBe(text);
  });
});
