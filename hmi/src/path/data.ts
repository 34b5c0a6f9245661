// The planned and the driven path, as both views of it read them.
import { computed, signal } from '@preact/signals';
import { query } from '../link/orders';
import { whenPicture } from '../link/socket';
import * as state from '../link/state';
import { checked } from './checked';

export interface PathAnswer {
  axes?: string;
  number?: number;
  planned?: number[][];
  driven?: number[][];
  errors?: number[];
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

async function look(): Promise<void> {
  try {
    const answer = await query<PathAnswer>('path');
    if ((answer.planned?.length ?? 0) > 1) {
      planned.value = answer.planned ?? [];
      plannedIs.value = 'running';
    } else if (checked.peek()?.path !== undefined) {
      planned.value = checked.peek()?.path ?? [];
      plannedIs.value = 'checked';
    }
    if (answer.driven !== undefined && answer.driven.length > 0)
      driven.value = answer.driven.map(([at = 0, ...place], i) => ({ at, place, error: answer.errors?.[i] ?? 0 }));
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
  const stopShowing = checked.subscribe((result) => {
    if (result?.path === undefined) return;
    planned.value = result.path;
    plannedIs.value = 'checked';
  });
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
