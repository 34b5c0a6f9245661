// Workpiece under a scan head: the program's answer and its drawing.
import type { CarrierState } from './carrier';

export type Place = [number, number];
export interface PieceAnswer {
  scanner: string;
  marks: Place[][];
  marking?: [Place, Place];
  points: number;
  lost_points: number;
  marked_mm: number;
  beam: Place;
  laser: boolean;
  /** A square, mm. */
  field: { min: Place; max: Place };
  part?: CarrierState;
}

/** Left, top, width and height of the picture, y downwards: around the marks, or around the field without marks. */
export function sight(piece: PieceAnswer): [number, number, number, number] {
  const marks = piece.marks.flat();
  const points = marks.length > 0 ? marks : [piece.field.min, piece.field.max];
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const pad = Math.max(1, 0.04 * Math.max(x1 - x0, y1 - y0));
  return [x0 - pad, -y1 - pad, x1 - x0 + 2 * pad, y1 - y0 + 2 * pad];
}

/** All marks, including the unfinished one. */
export const strokesOf = (piece: PieceAnswer): Place[][] =>
  piece.marking === undefined ? piece.marks : [...piece.marks, piece.marking];

/** Attribute d of a path, y downwards. */
export const pathOf = (strokes: readonly (readonly Place[])[]): string =>
  strokes.map((one) => one.map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x} ${-y}`).join('')).join('');
