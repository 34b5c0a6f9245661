// Last recording of the scope in chart format: wire edges and number samples over one list of times.
import { signal } from '@preact/signals';
import uPlot from 'uplot';
import { hello } from '../link/state';

interface Trace {
  name: string;
  unit: string;
  /** Every change with its time; otherwise equidistant samples. */
  edges: boolean;
  values: (number | null)[];
  at?: number[];
  before?: number;
}
/** Times in seconds from the trigger. */
interface Capture {
  number: number;
  trigger_at: number;
  from: number;
  to: number;
  period: number;
  first_sample: number;
  full: boolean;
  traces: Trace[];
}
export interface ScopeAnswer {
  state: string;
  capture?: Capture | null;
}
interface Recorded {
  number: number;
  names: string[];
  /** Names of channels that hold their value until the next change. */
  stepped: string[];
  /** Milliseconds, then one row per channel. */
  rows: (number | null)[][];
}

export const recorded = signal<Recorded>({ number: 0, names: [], stepped: [], rows: [] });

function table(trace: Trace, capture: Capture): [number[], (number | null)[]] {
  const ms = (s: number): number => s * 1000;
  if (!trace.edges) return [trace.values.map((_, i) => ms(capture.first_sample + i * capture.period)), trace.values];
  const last = trace.values[trace.values.length - 1] ?? trace.before ?? null;
  return [[capture.from, ...(trace.at ?? []), capture.to].map(ms), [trace.before ?? null, ...trace.values, last]];
}

/** Captures are counted from the start of the program. */
let boot: string | undefined;
hello.subscribe((now) => {
  if (now !== null && boot !== now.boot) recorded.value = { number: 0, names: [], stepped: [], rows: [] };
  boot = now?.boot ?? boot;
});

export function keep(answer: ScopeAnswer): void {
  const capture = answer.capture;
  if (capture == null || capture.number === recorded.peek().number) return;
  const tables = capture.traces.map((trace) => table(trace, capture) as unknown as uPlot.AlignedData);
  recorded.value = {
    number: capture.number,
    names: capture.traces.map((trace) => trace.name),
    stepped: capture.traces.filter((trace) => trace.edges).map((trace) => trace.name),
    rows: (tables.length === 0 ? [] : uPlot.join(tables)).map((row) =>
      [...(row as (number | null | undefined)[])].map((value) => value ?? null),
    ),
  };
}
