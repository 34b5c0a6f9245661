// What the dry run of the program in the panel found.
import { signal } from '@preact/signals';

export interface Check {
  ok?: boolean;
  lines?: number;
  seconds?: number;
  least?: Record<string, number>;
  greatest?: Record<string, number>;
  problems?: { line?: number; column?: number; message: string }[];
  axes?: string;
  path?: number[][];
}

export const checked = signal<Check | null>(null);
