// Last seconds of some channels, for small charts beside the numbers.
import { signal, type Signal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { channelNames } from '../link/rack';
import { whenPicture } from '../link/socket';

/** x in seconds before now, then one array per channel, in the format of a chart. */
type Rows = (number | null)[][];

/** Minimum redraw interval of a chart. */
const DRAWN_MS = 50;

/** Fills `data` until the returned function is called. `rate` in samples per second. */
export function record(names: readonly string[], rate: number, seconds: number, data: Signal<Rows>): () => void {
  const stop = want([...names], rate);
  const rows: { at: number; values: (number | null)[] }[] = [];
  let shown = 0;
  const unhook = whenPicture((picture) => {
    rows.push({ at: picture.at, values: names.map((name) => channel(name).peek()) });
    while (rows.length > 2 && (rows[0]?.at ?? 0) < picture.at - seconds) rows.shift();
    if (performance.now() - shown < DRAWN_MS) return;
    shown = performance.now();
    data.value = [
      rows.map((row) => row.at - picture.at),
      ...names.map((_, i) => rows.map((row) => row.values[i] ?? null)),
    ];
  });
  return () => {
    stop();
    unhook();
  };
}

/** History of those channels that the rack has. */
export function useHistory(names: readonly string[], rate: number, seconds: number): Signal<Rows> {
  const key = names.filter((name) => channelNames.value.has(name)).join(' ');
  const list = useMemo(() => (key === '' ? [] : key.split(' ')), [key]);
  const data = useMemo(() => signal<Rows>([[], ...list.map(() => [])]), [list]);
  useEffect(() => record(list, rate, seconds, data), [list, data, rate, seconds]);
  return data;
}
