// Jogging: a lease that is renewed while a key or a button is held, and ended by every event that may mean that none is
// held.
//
//   begin ──► jog ──80 ms──► jog (renews) ──80 ms──► ...
//   end, blur, hidden, page gone, connection lost, arm switch off ──► jog_stop
//
// Commands are numbered, so that a late one does not move anything. A rejected renewal ends the hold: another cause has
// stopped the axis, and only a new press may move it.
//
// The program itself stops an axis that was not renewed for 250 ms; this page only reacts faster.
import { signal } from '@preact/signals';
import { axisOf } from '../link/state';
import { command } from '../link/commands';
import { ask, whenLost } from '../link/socket';

export const RENEW_MS = 80;

/** Step lengths in mm or degrees; null: continuous. */
export const STEPS: readonly (number | null)[] = [0.001, 0.01, 0.1, 1, 10, null];

const kept = Number(localStorage.getItem('motionrack.jog.step') ?? 3);
export const stepIndex = signal(kept >= 0 && kept < STEPS.length ? kept : 3);
/** Jog speed as a fraction of each axis' maximum velocity. */
export const speedPart = signal(Number(localStorage.getItem('motionrack.jog.speed') ?? 0.2) || 0.2);
/** Arm switch of the keyboard. */
export const armed = signal(false);
/** Held axes, for the appearance of the buttons. */
export const jogging = signal('');

export function setStep(index: number): void {
  stepIndex.value = index;
  localStorage.setItem('motionrack.jog.step', String(index));
  endAll();
}

export function setSpeedPart(part: number): void {
  speedPart.value = part;
  localStorage.setItem('motionrack.jog.speed', String(part));
}

interface Held {
  axis: string;
  direction: 1 | -1;
  rapid: boolean;
}

const held = new Map<string, Held>();
let sequence = 0;
let timer: ReturnType<typeof setInterval> | undefined;

const speedOf = (axis: string, rapid: boolean): number =>
  (axisOf(axis)?.max_velocity ?? 0) * (rapid ? 1 : speedPart.value);

const speedFor = (one: Held): number => one.direction * speedOf(one.axis, one.rapid);

function renew(): void {
  for (const [who, one] of held)
    ask({ command: 'jog', axis: one.axis, speed: speedFor(one), sequence: ++sequence, renews: true }).catch(() =>
      drop(who, one),
    );
}

/** Ends this hold; a hold that replaced it stays. */
function drop(who: string, one: Held): void {
  if (held.get(who) !== one) return;
  held.delete(who);
  settle();
}

function tell(): void {
  jogging.value = [...held.values()].map((one) => (one.direction < 0 ? '-' : '+') + one.axis).join('');
}

/** Starts a jog: `who` (a key or a button) is pressed. In step mode each press is one move; holding has no effect. */
export function begin(who: string, axis: string, direction: 1 | -1, rapid = false): void {
  if (axisOf(axis) === undefined || held.has(who)) return;
  const step = STEPS[stepIndex.value];
  if (step !== null && step !== undefined) {
    void command('jog_by', { axis, distance: direction * step, speed: speedOf(axis, rapid) });
    return;
  }
  for (const [other, one] of held) if (one.axis === axis) held.delete(other);
  const one: Held = { axis, direction, rapid };
  held.set(who, one);
  tell();
  void command('jog', { axis, speed: speedFor(one), sequence: ++sequence }).then((taken) => {
    if (!taken) drop(who, one);
  });
  timer ??= setInterval(renew, RENEW_MS);
}

export function end(who: string): void {
  const one = held.get(who);
  if (one === undefined) return;
  held.delete(who);
  if (held.size > 0) ask({ command: 'jog', axis: one.axis, speed: 0, sequence: ++sequence }).catch(() => undefined);
  settle();
}

/** Continues rapid jogs at normal speed. */
export function slowDown(): void {
  for (const one of held.values()) one.rapid = false;
}

/** Ends every jog of any key or button. */
export function endAll(): void {
  if (held.size === 0) return;
  held.clear();
  settle();
}

/** After the last release, stops all jogging axes. */
function settle(): void {
  tell();
  if (held.size > 0) return;
  ask({ command: 'jog_stop', sequence: ++sequence }).catch(() => undefined);
  clearInterval(timer);
  timer = undefined;
}

export function setArmed(on: boolean): void {
  armed.value = on;
  if (!on) endAll();
}

window.addEventListener('blur', endAll);
window.addEventListener('pagehide', endAll);
document.addEventListener('visibilitychange', () => {
  if (document.hidden) endAll();
});
whenLost(endAll);
