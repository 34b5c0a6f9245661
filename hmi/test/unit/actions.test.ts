// Actions of buttons and keys: the commands that they send, and the reasons why they are not allowed.
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
  test('starts the program that is in the panel', async () => {
    const { actions, program } = await opened(STORED);
    actions.perform(actions.actions.run);
    expect(program.asked('start_program')).toEqual([{ command: 'start_program', name: 'part.ngc', text: 'G0 X1\nM2' }]);
  });

  test('resumes a program after a feed hold', async () => {
    const { actions, program } = await opened({ ...STORED, machine: { state: 'hold' } });
    actions.perform(actions.actions.run);
    expect(commands(program)).toEqual(['resume']);
  });

  test('asks for a program if none is open', async () => {
    const { actions, notices, program } = await opened();
    actions.perform(actions.actions.run);
    expect(commands(program)).toEqual([]);
    expect(await notices()).toEqual(['No program is open. Open one, or type one, first.']);
  });
});

describe('single block', () => {
  test('is enabled before the program is started', async () => {
    const { actions, program } = await opened(STORED);
    program.answers.set_single_block = {};
    actions.perform(actions.actions.step);
    await settled();
    expect(commands(program)).toEqual(['set_single_block', 'start_program']);
  });

  test('starts nothing if it is refused', async () => {
    const { actions, program } = await opened(STORED);
    program.answers.set_single_block = 'Not while it homes.';
    actions.perform(actions.actions.step);
    await settled();
    expect(commands(program)).toEqual(['set_single_block']);
  });
});

describe('the position of an axis', () => {
  test('is set in machine coordinates', async () => {
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

  test.each(['declare', 'touchOff'] as const)('is not sent if it is not a number (%s)', async (name) => {
    const { actions, notices, program } = await opened();
    actions.placeText.value = 'here';
    actions.perform(actions.actions[name]);
    expect(commands(program)).toEqual([]);
    expect(await notices()).toEqual(['"here" is not a position. Nothing was changed.']);
  });

  test('is that of the first axis if the machine does not have the chosen one', async () => {
    const { actions } = await opened({ machine: { axes: [axis('U'), axis('V')] } });
    expect(actions.axisLetter()).toBe('U');
  });
});

describe('switches', () => {
  test.each([
    ['disabled', true],
    ['standstill', false],
    ['error_stop', false],
  ])('enable the drives of a machine in state %s: %s', async (state, on) => {
    const { actions, program } = await opened({ machine: { state } });
    actions.perform(actions.actions.enable);
    expect(program.asked('enable')).toEqual([{ command: 'enable', on }]);
  });

  test.each([true, false])('toggle the emergency stop (pressed: %s)', async (pressed) => {
    const { actions, program } = await opened({ machine: { estop: { wired: true, pressed } } });
    actions.perform(actions.actions.estop);
    expect(program.asked('set_estop')).toEqual([{ command: 'set_estop', pressed: !pressed }]);
  });

  test('do not press an emergency stop that is not wired', async () => {
    const { actions, notices, program } = await opened({ machine: { estop: { wired: false, pressed: false } } });
    actions.perform(actions.actions.estop);
    expect(commands(program)).toEqual([]);
    expect((await notices()).join()).toMatch(/wires no emergency stop/);
  });
});

describe('permissions', () => {
  const names = ['resume', 'reset', 'enable', 'home', 'touchOff', 'declare', 'run', 'step'] as const;

  test('refuse every motion from a tab without control and report the reason', async () => {
    const { actions, notices, program } = await opened({ ...STORED, machine: { control: { holder: 'bert' } } });
    for (const name of names) actions.perform(actions.actions[name]);
    actions.setFeed(0.5);
    expect(commands(program)).toEqual([]);
    expect((await notices()).at(-1)).toBe('Feed override: bert holds control.');
  });

  test('allow a feed hold without control, and STOP without a role', async () => {
    const { actions, program } = await opened({ role: 'operate', machine: { control: { holder: 'bert' } } });
    actions.perform(actions.actions.hold);
    expect(commands(program)).toEqual(['hold']);
    const observing = await opened({ role: 'observe' });
    observing.actions.perform(observing.actions.actions.hold);
    observing.actions.perform(observing.actions.actions.stop);
    expect(commands(observing.program)).toEqual(['stop']);
  });

  test('allow an alarm to be acknowledged by its number', async () => {
    const { actions, program } = await opened({ machine: { control: { holder: 'bert' } } });
    actions.perform(actions.acknowledge(7));
    expect(program.asked('acknowledge_alarm')).toEqual([{ command: 'acknowledge_alarm', alarm: 7 }]);
  });
});
