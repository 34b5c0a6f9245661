// The planned and the driven path, as both views of it read them.
import { computed, signal } from '@preact/signals';
import { query } from '../link/orders';
import { whenPicture } from '../link/socket';
import * as state from '../link/state';
import { checked, type Polyline } from './checked';

/** `driven`: time, then places by the letters of `axes`; oldest first. */
interface PathAnswer {
  planned?: Polyline | null;
  driven?: { axes: string; points: number[][]; errors?: number[] };
}

export const letters = computed(() => state.axisLetters.value.slice(0, 4));
/** Points of machine coordinates by axis; of a checked program that does not run yet, or of the one that runs. */
export const planned = signal<number[][]>([]);
export interface Driven {
  at: number;
  place: number[];
  error: number;
}
export const driven = signal<Driven[]>([]);
export const plannedIs = signal<'none' | 'checked' | 'running'>('none');

const KEPT = 6000;
const EVERY_MS = 400;

/** Without the program's own list the page keeps what it saw pass by. */
function note(): void {
  const status = state.status.peek();
  if (status === null) return;
  const place = status.axes.map((axis) => axis.actual);
  const error = Math.hypot(...status.axes.map((axis) => axis.error));
  const list = driven.peek();
  const last = list[list.length - 1];
  if (last !== undefined && last.place.every((value, i) => Math.abs(value - (place[i] ?? 0)) < 1e-6)) return;
  driven.value = [...list, { at: status.at, place, error }].slice(-KEPT);
}

/** Places in the order of the page's axes. */
function inOrder(axes: string, points: readonly number[][]): number[][] {
  const from = [...letters.peek()].map((letter) => axes.indexOf(letter));
  return points.map((point) => from.map((i) => point[i] ?? 0));
}

function show(path: Polyline | null | undefined, is: 'checked' | 'running'): void {
  if (path === null || path === undefined || path.points.length < 2) return;
  planned.value = inOrder(path.axes, path.points);
  plannedIs.value = is;
}

async function look(): Promise<void> {
  try {
    const answer = await query<PathAnswer>('path');
    if ((answer.planned?.points.length ?? 0) > 1) show(answer.planned, 'running');
    else show(checked.peek()?.path, 'checked');
    const list = answer.driven;
    if (list !== undefined && list.points.length > 0) {
      const places = inOrder(list.axes, list.points.map(([, ...place]) => place));
      driven.value = places.map((place, i) => ({ at: list.points[i]?.[0] ?? 0, place, error: list.errors?.[i] ?? 0 }));
    }
  } catch {
    // The view then shows what the stream told.
  }
}

/** Follows the path while a view of it is open. */
export function follow(): () => void {
  let live = true;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const again = async (): Promise<void> => {
    if (state.link.peek() === 'open' && !document.hidden) await look();
    if (live) timer = setTimeout(() => void again(), EVERY_MS);
  };
  void again();
  const stopNoting = whenPicture(note);
  const stopShowing = checked.subscribe((result) => show(result?.path, 'checked'));
  return () => {
    live = false;
    clearTimeout(timer);
    stopNoting();
    stopShowing();
  };
}

export const clearDriven = (): void => void (driven.value = []);
/** The greatest error of the driven points, at least so much that a good path is all of one colour. */
export const greatestError = computed(() => Math.max(0.001, ...driven.value.slice(-KEPT).map((one) => one.error)));
