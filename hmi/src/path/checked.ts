// What the dry run of the program in the panel found.
import { signal } from '@preact/signals';

/** Points by the letters of `axes`. */
export interface Polyline {
  axes: string;
  points: number[][];
}

export interface Check {
  good: boolean;
  problems: { line: number; column: number; message: string }[];
  more_problems?: number;
  lines: number;
  moves?: number;
  seconds?: number;
  path_mm?: number;
  extents?: Record<string, [number, number]>;
  path?: Polyline;
}

export const checked = signal<Check | null>(null);
