// Keyboard table, used by the key handler and shown in the help.
import { actions, perform, setFeed } from '../actions';
import { axes } from '../link/state';
import { dialogOpen, inviteOpen } from '../link/pairing';
import { setStep, stepIndex, STEPS } from '../jog/lease';
import { helpOpen } from '../view';

export interface Key {
  /** KeyboardEvent.key values of this action. */
  keys: readonly string[];
  /** Label in the help. */
  shown: string;
  text: string;
  ctrl?: boolean;
  /** Also active while typing in a field. */
  always?: boolean;
  press(key: string): void;
}

export interface JogKey {
  keys: readonly [minus: string, plus: string];
  shown: string;
  /** Selects an axis from those of the machine. */
  axis(letters: readonly string[]): string | undefined;
  text: string;
}

export const KEYS: readonly Key[] = [
  {
    keys: ['Escape'],
    shown: 'Esc',
    text: 'STOP: controlled stop, the program is aborted',
    always: true,
    press: escape,
  },
  {
    keys: [' '],
    shown: 'Space',
    text: 'Feed hold; a second press does not resume',
    press: () => perform(actions.hold),
  },
  {
    keys: ['F1'],
    shown: 'F1',
    text: 'E-stop input on or off (simulated)',
    always: true,
    press: () => perform(actions.estop),
  },
  {
    keys: ['F2'],
    shown: 'F2',
    text: 'Enable or disable the drives',
    always: true,
    press: () => perform(actions.enable),
  },
  { keys: ['i'], shown: 'i', text: 'Next jog increment', press: nextStep },
  { keys: ['c'], shown: 'c', text: 'Continuous jog', press: () => setStep(STEPS.length - 1) },
  { keys: ['Home'], shown: 'Ctrl + Home', text: 'Home all axes', ctrl: true, press: () => perform(actions.home) },
  {
    keys: ['End'],
    shown: 'End',
    text: 'Touch off: the chosen axis stands at 0 of the work piece',
    press: () => perform(actions.touchOff),
  },
  { keys: ['r', '~'], shown: 'r or ~', text: 'Run the program', press: () => perform(actions.run) },
  { keys: ['t'], shown: 't', text: 'Single block', press: () => perform(actions.step) },
  { keys: ['p', '!'], shown: 'p or !', text: 'Pause (feed hold)', press: () => perform(actions.hold) },
  { keys: ['s'], shown: 's', text: 'Resume', press: () => perform(actions.resume) },
  {
    keys: ['1', '2', '3', '4', '5', '6', '7', '8', '9'],
    shown: '1 … 9',
    text: 'Feed override 10 … 90 %',
    press: (key) => setFeed(Number(key) / 10),
  },
  { keys: ['0'], shown: '0', text: 'Feed override 100 %', press: () => setFeed(1) },
  { keys: ['`'], shown: '`', text: 'Feed override 0 %', press: () => setFeed(0) },
  { keys: ['?'], shown: '?', text: 'This help', press: () => (helpOpen.value = !helpOpen.peek()) },
];

const named = (letter: string) => (letters: readonly string[]) => letters.find((one) => one === letter);

/** Active only while the keyboard is armed; Shift selects the maximum velocity. */
export const JOG_KEYS: readonly JogKey[] = [
  { keys: ['ArrowLeft', 'ArrowRight'], shown: '← →', text: 'Jog X − / +', axis: named('X') },
  { keys: ['ArrowDown', 'ArrowUp'], shown: '↓ ↑', text: 'Jog Y − / +', axis: named('Y') },
  { keys: ['PageDown', 'PageUp'], shown: 'PgDn PgUp', text: 'Jog Z − / +', axis: named('Z') },
  {
    keys: ['[', ']'],
    shown: '[ ]',
    text: 'Jog the fourth axis − / +',
    axis: (letters) => letters.find((one) => !'XYZ'.includes(one)),
  },
];

/** Axes on the jog pad: in the cross, and in columns beside it. */
export function padOf(letters: readonly string[]): { x?: string; y?: string; columns: string[] } {
  const [x, y, ...upright] = JOG_KEYS.map((row) => row.axis(letters));
  const keyed = upright.filter((one): one is string => one !== undefined);
  return { x, y, columns: [...keyed, ...letters.filter((one) => ![x, y, ...keyed].includes(one))] };
}

/** STOP first; then closes an open dialog. */
function escape(): void {
  perform(actions.stop);
  helpOpen.value = dialogOpen.value = inviteOpen.value = false;
}

function nextStep(): void {
  const distances = STEPS.length - 1;
  setStep((stepIndex.peek() + 1) % distances);
}

/** Axis and direction of a jog key; null if it is not one or the machine lacks the axis. */
export function jogOf(key: string): { axis: string; direction: 1 | -1 } | null {
  for (const row of JOG_KEYS) {
    const which = row.keys.indexOf(key === '{' ? '[' : key === '}' ? ']' : key);
    const axis = row.axis(axes.peek().map((one) => one.letter));
    if (which >= 0 && axis !== undefined) return { axis, direction: which === 0 ? -1 : 1 };
  }
  return null;
}
