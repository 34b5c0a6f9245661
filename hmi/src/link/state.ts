// Machine state on the page: signals read by panels, written only by the link.
import { computed, effect, signal } from '@preact/signals';
import type { AxisStatus, Hello, MachineEvent, Role, StateName, Status } from './contract';

export type LinkState = 'connecting' | 'open' | 'lost';

export const link = signal<LinkState>('connecting');
export const hello = signal<Hello | null>(null);
export const role = signal<Role>('observe');
export const user = signal('');
export const status = signal<Status | null>(null);
/** performance.now() of the newest snapshot. */
export const received = signal(0);
/** Snapshots lost since the page was opened. */
export const lost = signal(0);
export const events = signal<MachineEvent[]>([]);

/** Milliseconds since the newest snapshot, updated ten times a second. */
export const age = signal(Infinity);
export const STALE_MS = 500;
const AGE_STEP_MS = 50;
export const stale = computed(() => link.value !== 'open' || age.value >= STALE_MS);

/** Tenths of a second if the age is significant; otherwise a fixed bound that does not flicker. */
export function ageText(ms: number): string {
  if (!Number.isFinite(ms)) return '';
  return ms >= STALE_MS ? `${(ms / 1000).toFixed(1)} s old` : `< ${Math.ceil((ms + 1) / 100) * 100} ms`;
}

export function lookAtAge(): void {
  age.value =
    received.peek() === 0
      ? Infinity
      : Math.max(0, Math.floor((performance.now() - received.peek()) / AGE_STEP_MS) * AGE_STEP_MS);
}
setInterval(lookAtAge, 100);
effect(() => {
  document.documentElement.classList.toggle('stale', stale.value);
});

export function stateName(text: string): StateName {
  return text.replace(/_/g, ' ') as StateName;
}

export const machineState = computed<StateName>(() => stateName(status.value?.state ?? 'disabled'));
export const axes = computed<AxisStatus[]>(() => status.value?.axes ?? []);
/** Changes only with the axes themselves, not with their numbers. */
export const axisLetters = computed(() => axes.value.map((axis) => axis.letter).join(''));
export const openAlarms = computed(() =>
  (status.value?.alarms ?? []).filter((alarm) => alarm.active || !alarm.acknowledged),
);
export const standsStill = computed(() => ['standstill', 'disabled', 'error stop'].includes(machineState.value));
/** Control may be taken from its holder. */
export const mayBeTakenOver = computed(() => standsStill.value || machineState.value === 'hold');

/** This tab holds control. */
export const inControl = computed(() => {
  const control = status.value?.control;
  return control?.holder_session !== undefined && control.holder_session === hello.value?.session;
});
/** Name of the holder of control for display; empty: none. */
export const holder = computed(() => {
  const control = status.value?.control;
  return control?.holder == null ? '' : control.holder || 'another browser';
});

export const axisOf = (letter: string): AxisStatus | undefined => axes.value.find((axis) => axis.letter === letter);
