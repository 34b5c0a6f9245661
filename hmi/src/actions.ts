// Actions of buttons and keys: one table of permissions and commands.
import { signal } from '@preact/signals';
import { axes, machineState, status } from './link/state';
import { mayOperate, notice, command, stop, whyNot } from './link/commands';
import { typed } from './parts/numbers';
import * as text from './program/text';

export interface Action {
  label: string;
  /** Reason why it is not allowed now; empty: allowed. */
  why(): string;
  run(): void;
}

/** The axis for touch off, and the new position in the work offset. */
export const chosenAxis = signal('X');
export const placeText = signal('0');

function startText(): void {
  if (machineState.value === 'hold') void command('resume');
  else if (text.program.value === '') notice('refused', 'No program is open. Open one, or type one, first.');
  else void command('start_program', { name: text.programName.value, text: text.program.value });
}

async function oneStep(): Promise<void> {
  if (!(await command('set_single_block', { on: true }))) return;
  startText();
}

/** The chosen axis, or the first one if the machine does not have it. */
export const axisLetter = (): string =>
  axes.value.some((axis) => axis.letter === chosenAxis.value) ? chosenAxis.value : (axes.value[0]?.letter ?? '');

function declare(): void {
  const position = typed(placeText.value);
  if (position === null) notice('refused', `"${placeText.value}" is not a position. Nothing was changed.`);
  else void command('set_position', { axis: axisLetter(), position });
}

function touchOff(): void {
  const place = typed(placeText.value);
  if (place === null) notice('refused', `"${placeText.value}" is not a position. Nothing was changed.`);
  else void command('touch_off', { axis: axisLetter(), value: place });
}

const enabled = (): boolean => machineState.value !== 'disabled';

export const actions = {
  stop: { label: 'STOP', why: () => '', run: stop },
  hold: { label: 'Feed hold', why: () => whyNot('operate'), run: () => void command('hold') },
  resume: { label: 'Resume', why: mayOperate, run: () => void command('resume') },
  reset: { label: 'Reset', why: mayOperate, run: () => void command('reset') },
  enable: { label: 'Enable drives', why: mayOperate, run: () => void command('enable', { on: !enabled() }) },
  estop: {
    label: 'E-stop input (simulated)',
    why: () =>
      whyNot('operate') || (status.value?.estop.wired === false ? 'The rack file wires no emergency stop.' : ''),
    run: () => void command('set_estop', { pressed: !status.value?.estop.pressed }),
  },
  home: { label: 'Home all', why: mayOperate, run: () => void command('home') },
  touchOff: { label: 'Touch off', why: mayOperate, run: touchOff },
  declare: { label: 'Set position', why: mayOperate, run: declare },
  run: { label: 'Run', why: mayOperate, run: startText },
  step: { label: 'Single block', why: mayOperate, run: () => void oneStep() },
} satisfies Record<string, Action>;

export const acknowledge = (alarm: number): Action => ({
  label: 'Acknowledge',
  why: () => whyNot('operate'),
  run: () => void command('acknowledge_alarm', { alarm }),
});

/** Performs the action, or shows why it is not allowed. */
export function perform(action: Action): void {
  const why = action.why();
  if (why === '') action.run();
  else notice('refused', `${action.label}: ${why}`);
}

export function setFeed(part: number): void {
  perform({ label: 'Feed override', why: mayOperate, run: () => void command('set_overrides', { feed: part }) });
}
