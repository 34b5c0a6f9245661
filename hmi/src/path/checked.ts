// Result of the dry run of the program in the panel.
import { signal } from '@preact/signals';

export interface Check {
  ok: boolean;
  problems: { line: number; column: number; message: string }[];
  more_problems?: number;
  lines: number;
  moves?: number;
  duration_s?: number;
  length_mm?: number;
  min?: Record<string, number>;
  max?: Record<string, number>;
  /** Axis letters; positions are in this order. */
  axes: string;
  path?: number[][];
}

export const checked = signal<Check | null>(null);
