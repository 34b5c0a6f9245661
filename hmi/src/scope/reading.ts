// Reads a recording: index of a cursor, channel value there, and export as a table.

/** The first row is x, then one row per channel. */
export type Rows = readonly (readonly (number | null)[])[];

/** Returns the value of a channel at an index: the last one that is not missing. */
export function valueAt(values: readonly (number | null)[], at: number): number | null {
  for (let i = at; i >= 0; --i) if (values[i] != null) return values[i] ?? null;
  return null;
}

/** Index of the time nearest to x. */
export function nearest(times: readonly (number | null)[], x: number): number {
  let best = 0;
  times.forEach((time, i) => {
    if (Math.abs((time ?? 0) - x) < Math.abs((times[best] ?? 0) - x)) best = i;
  });
  return best;
}

/** Default cursors at one third and two thirds; null: too few times for two cursors. */
export function thirds(times: readonly (number | null)[]): [number, number] | null {
  if (times.length <= 3) return null;
  return [times[Math.floor(times.length / 3)] ?? 0, times[Math.floor((2 * times.length) / 3)] ?? 0];
}

/** Comma-separated values; empty if a channel did not change. */
export function csv(names: readonly string[], rows: Rows): string {
  const lines = (rows[0] ?? []).map((time, i) => [time, ...names.map((_, n) => rows[n + 1]?.[i] ?? '')].join(','));
  return [['time_ms', ...names].join(','), ...lines, ''].join('\n');
}
