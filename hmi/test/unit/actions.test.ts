// Actions of buttons and keys: the commands that they send, and the reason where they may not.
import { describe, expect, test } from 'vitest';
import { settled } from './browser';
import { axis, connected, type Program } from './program';

type Actions = typeof import('../../src/actions');

async function opened(
  settings: Parameters<typeof connected>[0] = {},
): Promise<{ actions: Actions; program: Program; notices: () => Promise<string[]> }> {
  const { program } = await connected(settings);
  const notices = async (): Promise<string[]> =>
    (await import('../../src/link/commands')).notices.value.map((one) => one.text);
  return { actions: await import('../../src/actions'), program, notices };
}

const STORED = { stored: { 'motionrack.program': 'G0 X1\nM2', 'motionrack.program.name': 'part.ngc' } };
const commands = (program: Program): unknown[] => program.heard.map((one) => one.command).filter(Boolean);

describe('run', () => {
  test('begins the text that is in the panel', async () => {
    const { actions, program } = await opened(STORED);
    actions.perform(actions.actions.run);
    expect(program.asked('start_program')).toEqual([{ command: 'start_program', name: 'part.ngc', text: 'G0 X1\nM2' }]);
  });

  test('resumes a program that is held', async () => {
    const { actions, program } = await opened({ ...STORED, machine: { state: 'hold' } });
    actions.perform(actions.actions.run);
    expect(commands(program)).toEqual(['resume']);
  });

  test('without a program requests one', async () => {
    const { actions, notices, program } = await opened();
    actions.perform(actions.actions.run);
    expect(commands(program)).toEqual([]);
    expect(await notices()).toEqual(['No program is open. Open one, or type one, first.']);
  });
});

describe('a single block', () => {
  test('is chosen first, then the program is run', async () => {
    const { actions, program } = await opened(STORED);
    program.answers.set_single_block = {};
    actions.perform(actions.actions.step);
    await settled();
    expect(commands(program)).toEqual(['set_single_block', 'start_program']);
  });

  test('that is refused runs nothing', async () => {
    const { actions, program } = await opened(STORED);
    program.answers.set_single_block = 'Not while it homes.';
    actions.perform(actions.actions.step);
    await settled();
    expect(commands(program)).toEqual(['set_single_block']);
  });
});

describe('the place of an axis', () => {
  test('is declared in machine coordinates', async () => {
    const { actions, program } = await opened();
    actions.chosenAxis.value = 'Y';
    actions.placeText.value = '12,5';
    actions.perform(actions.actions.declare);
    expect(program.asked('set_position')).toEqual([{ command: 'set_position', axis: 'Y', position: 12.5 }]);
  });

  test('is touched off in work coordinates', async () => {
    const { actions, program } = await opened();
    actions.placeText.value = '−3';
    actions.perform(actions.actions.touchOff);
    expect(program.asked('touch_off')).toEqual([{ command: 'touch_off', axis: 'X', value: -3 }]);
  });

  test.each(['declare', 'touchOff'] as const)('that is no number is not sent (%s)', async (name) => {
    const { actions, notices, program } = await opened();
    actions.placeText.value = 'here';
    actions.perform(actions.actions[name]);
    expect(commands(program)).toEqual([]);
    expect(await notices()).toEqual(['"here" is not a position. Nothing was changed.']);
  });

  test('is that of the first axis where the machine does not have the chosen one', async () => {
    const { actions } = await opened({ machine: { axes: [axis('U'), axis('V')] } });
    expect(actions.axisLetter()).toBe('U');
  });
});

describe('switches', () => {
  test.each([
    ['disabled', true],
    ['standstill', false],
    ['error_stop', false],
  ])('the drives of a machine that is %s are enabled: %s', async (state, on) => {
    const { actions, program } = await opened({ machine: { state } });
    actions.perform(actions.actions.enable);
    expect(program.asked('enable')).toEqual([{ command: 'enable', on }]);
  });

  test.each([true, false])('the emergency stop that is pressed: %s, is turned over', async (pressed) => {
    const { actions, program } = await opened({ machine: { estop: { wired: true, pressed } } });
    actions.perform(actions.actions.estop);
    expect(program.asked('set_estop')).toEqual([{ command: 'set_estop', pressed: !pressed }]);
  });

  test('an emergency stop that is not wired cannot be pressed', async () => {
    const { actions, notices, program } = await opened({ machine: { estop: { wired: false, pressed: false } } });
    actions.perform(actions.actions.estop);
    expect(commands(program)).toEqual([]);
    expect((await notices()).join()).toMatch(/wires no emergency stop/);
  });
});

describe('who may', () => {
  const names = ['resume', 'reset', 'enable', 'home', 'touchOff', 'declare', 'run', 'step'] as const;

  test('a tab without control moves nothing and reports the reason', async () => {
    const { actions, notices, program } = await opened({ ...STORED, machine: { control: { holder: 'bert' } } });
    for (const name of names) actions.perform(actions.actions[name]);
    actions.setFeed(0.5);
    expect(commands(program)).toEqual([]);
    expect((await notices()).at(-1)).toBe('Feed override: bert holds control.');
  });

  test('hold needs no control, and STOP not even a role', async () => {
    const { actions, program } = await opened({ role: 'operate', machine: { control: { holder: 'bert' } } });
    actions.perform(actions.actions.hold);
    expect(commands(program)).toEqual(['hold']);
    const observing = await opened({ role: 'observe' });
    observing.actions.perform(observing.actions.actions.hold);
    observing.actions.perform(observing.actions.actions.stop);
    expect(commands(observing.program)).toEqual(['stop']);
  });

  test('an alarm is acknowledged by its number', async () => {
    const { actions, program } = await opened({ machine: { control: { holder: 'bert' } } });
    actions.perform(actions.acknowledge(7));
    expect(program.asked('acknowledge_alarm')).toEqual([{ command: 'acknowledge_alarm', alarm: 7 }]);
  });
});
