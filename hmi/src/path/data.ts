// Planned and actual path, shared by both views.
import { computed, signal } from '@preact/signals';
import { query } from '../link/commands';
import * as state from '../link/state';
import { checked, type Check } from './checked';

/**
 * `driven`: time, then positions in the order of `axes`; oldest first. `planned` only if it differs from the plan in
 * the query.
 */
interface PathAnswer {
  number: number;
  axes: string;
  planned?: number[][] | null;
  driven: number[][];
  errors?: number[];
}

export const letters = computed(() => state.axisLetters.value.slice(0, 4));
/** Points in machine coordinates by axis; of a checked program before its start, or of the running one. */
export const planned = signal<number[][]>([]);
export interface Driven {
  at: number;
  place: number[];
  error: number;
}
/** Oldest first. */
export const driven = signal<Driven[]>([]);
export const plannedIs = signal<'none' | 'checked' | 'running'>('none');

const KEPT = 6000;
const EVERY_MS = 200;

/** Number of the displayed plan, and the time up to which the actual path is hidden. */
let have = 0;
let since = -1;
let boot: string | undefined;
state.hello.subscribe((now) => {
  if (now === null || now.boot === boot) return;
  boot = now.boot;
  have = 0;
  since = -1;
  driven.value = [];
});

/** Sorts positions into the order of the page's axes. */
function inOrder(axes: string, points: readonly number[][]): number[][] {
  const from = [...letters.peek()].map((letter) => axes.indexOf(letter));
  return points.map((point) => from.map((i) => point[i] ?? 0));
}

function show(axes: string, path: number[][] | null | undefined, is: 'checked' | 'running'): void {
  if (path === null || path === undefined || path.length < 2) return;
  planned.value = inOrder(axes, path);
  plannedIs.value = is;
}

async function look(): Promise<void> {
  try {
    const list = driven.peek();
    const answer = await query<PathAnswer>('path', { have, since: list[list.length - 1]?.at ?? since });
    if (answer.number !== have) show(answer.axes, answer.planned, 'running');
    have = answer.number;
    if (answer.driven.length === 0) return;
    const places = inOrder(
      answer.axes,
      answer.driven.map(([, ...place]) => place),
    );
    driven.value = [
      ...list,
      ...places.map((place, i) => ({ at: answer.driven[i]?.[0] ?? 0, place, error: answer.errors?.[i] ?? 0 })),
    ].slice(-KEPT);
  } catch {
    // The next poll retries.
  }
}

/** Polls the path while a view is open. */
export function follow(): () => void {
  let live = true;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const again = async (): Promise<void> => {
    if (state.link.peek() === 'open' && !document.hidden) await look();
    if (live) timer = setTimeout(() => void again(), EVERY_MS);
  };
  void again();
  const stopShowing = checked.subscribe(
    (result: Check | null) => result !== null && show(result.axes, result.path, 'checked'),
  );
  return () => {
    live = false;
    clearTimeout(timer);
    stopShowing();
  };
}

export function clearDriven(): void {
  since = state.status.peek()?.at ?? since;
  driven.value = [];
}
/** Maximum error of the actual points, with a lower limit so that a good path has a single colour. */
export const maxError = computed(() => Math.max(0.001, ...driven.value.slice(-KEPT).map((one) => one.error)));
