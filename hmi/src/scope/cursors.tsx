// Two cursors over a recording: their times, the channel values there, and the differences.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { fixed } from '../parts/numbers';
import { nearest, thirds, valueAt, type Rows } from './reading';

/** Times of A and B, ms. */
const cursors = signal<[number, number]>([0, 0]);
/** Cursor that the next click on the chart moves. */
const moving = signal<0 | 1>(0);

function put(which: 0 | 1, x: number): void {
  const next: [number, number] = [...cursors.value];
  next[which] = x;
  cursors.value = next;
}

/** A click on the chart moves the cursors alternately. */
export function pick(x: number): void {
  put(moving.value, x);
  moving.value = moving.value === 0 ? 1 : 0;
}

/** Trigger and cursors as chart marks. */
export function marksOf(times: readonly (number | null)[]): { x: number; name: string }[] {
  if (cursors.value[0] === cursors.value[1]) cursors.value = thirds(times) ?? cursors.value;
  return [
    { x: 0, name: 'T' },
    { x: cursors.value[0], name: 'A' },
    { x: cursors.value[1], name: 'B' },
  ];
}

function Row({ name, a, b }: { name: string; a: number | null; b: number | null }): JSX.Element {
  return (
    <tr>
      <td>
        <code>{name}</code>
      </td>
      <td class="tabular">{fixed(a, 4)}</td>
      <td class="tabular">{fixed(b, 4)}</td>
      <td class="tabular">{a === null || b === null ? '–' : fixed(b - a, 4)}</td>
    </tr>
  );
}

export function Cursors({ data, names }: { data: Rows; names: readonly string[] }): JSX.Element {
  const times = data[0] ?? [];
  const [a, b] = cursors.value.map((x) => nearest(times, x)) as [number, number];
  const at = (i: number): number => times[i] ?? 0;
  return (
    <div class="cursors">
      {([0, 1] as const).map((which) => (
        <label key={which} class={moving.value === which ? 'moving' : ''}>
          <span>Cursor {which === 0 ? 'A' : 'B'}</span>
          <input
            type="range"
            min="0"
            max={Math.max(1, times.length - 1)}
            value={which === 0 ? a : b}
            onFocus={() => (moving.value = which)}
            onInput={(event) => put(which, at(Number(event.currentTarget.value)))}
          />
          <output class="tabular">{fixed(at(which === 0 ? a : b), 3)} ms</output>
        </label>
      ))}
      <table>
        <thead>
          <tr>
            <th scope="col">Channel</th>
            <th scope="col">A</th>
            <th scope="col">B</th>
            <th scope="col">B − A</th>
          </tr>
        </thead>
        <tbody>
          <tr>
            <td>time</td>
            <td class="tabular">{fixed(at(a), 3)}</td>
            <td class="tabular">{fixed(at(b), 3)}</td>
            <td class="tabular">{fixed(at(b) - at(a), 3)} ms</td>
          </tr>
          {names.map((name, i) => (
            <Row key={name} name={name} a={valueAt(data[i + 1] ?? [], a)} b={valueAt(data[i + 1] ?? [], b)} />
          ))}
        </tbody>
      </table>
    </div>
  );
}
