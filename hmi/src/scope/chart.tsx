// Chart of lines over one axis; the only user of uPlot.
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { dark } from '../view';

export interface Mark {
  x: number;
  name: string;
}

interface ChartProps {
  /** The first array is x. */
  data: (number | null)[][];
  names: readonly string[];
  xName: string;
  label: string;
  marks?: readonly Mark[];
  /** A line that holds its value until the next one. */
  stepped?: (name: string) => boolean;
  height?: number;
  onPick?: (x: number) => void;
}

/** Lines differ by dash as well as by colour. */
const DASHES: readonly number[][] = [[], [8, 4], [2, 3], [10, 3, 2, 3]];
export const LINES = 8;
export const lineColour = (style: CSSStyleDeclaration, i: number): string =>
  style.getPropertyValue(`--line-${(i % LINES) + 1}`).trim();
export const dashOf = (i: number): readonly number[] => DASHES[Math.floor(i / 2) % DASHES.length] ?? [];

function drawMarks(plot: uPlot, marks: readonly Mark[], colour: string): void {
  const { ctx: pen, bbox } = plot;
  pen.save();
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = devicePixelRatio;
  pen.font = `${12 * devicePixelRatio}px Inter Variable, sans-serif`;
  for (const mark of marks) {
    const x = plot.valToPos(mark.x, 'x', true);
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    pen.beginPath();
    pen.moveTo(x, bbox.top);
    pen.lineTo(x, bbox.top + bbox.height);
    pen.stroke();
    pen.fillText(mark.name, x + 4 * devicePixelRatio, bbox.top + 13 * devicePixelRatio);
  }
  pen.restore();
}

function options(box: HTMLElement, props: ChartProps, marks: () => readonly Mark[]): uPlot.Options {
  const style = getComputedStyle(box);
  const get = (name: string): string => style.getPropertyValue(name).trim();
  const axis: uPlot.Axis = {
    stroke: get('--muted'),
    grid: { stroke: get('--line'), width: 1 },
    ticks: { stroke: get('--line'), width: 1 },
    font: '11px Inter Variable, sans-serif',
  };
  const paths = uPlot.paths.stepped?.({ align: 1 });
  return {
    width: Math.max(100, box.clientWidth),
    height: Math.max(80, box.clientHeight),
    legend: { show: false },
    cursor: { drag: { x: true, y: false } },
    scales: { x: { time: false } },
    axes: [
      { ...axis, size: 34 },
      { ...axis, size: 62 },
    ],
    series: [
      { label: props.xName },
      ...props.names.map((name, i) => ({
        label: name,
        stroke: lineColour(style, i),
        width: 1.8,
        dash: [...dashOf(i)],
        points: { show: false },
        spanGaps: true,
        ...(props.stepped?.(name) === true && paths !== undefined ? { paths } : {}),
      })),
    ],
    hooks: { draw: [(plot) => drawMarks(plot, marks(), get('--amber'))] },
  };
}

/** uPlot draws its axes only with at least two points. */
const drawable = (data: (number | null)[][]): uPlot.AlignedData =>
  ((data[0]?.length ?? 0) < 2 ? [[0, 1], ...data.slice(1).map(() => [null, null])] : data) as uPlot.AlignedData;

export function Chart(props: ChartProps): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  // The plot outlives its initial properties, so it reads the newest.
  const now = useRef(props);
  now.current = props;
  const steps = props.names.map((name) => props.stepped?.(name) === true).join();
  const made = `${props.names.join(' ')}|${dark.value}|${steps}`;
  const marks = JSON.stringify(props.marks);
  useEffect(() => {
    const element = box.current;
    if (element === null) return undefined;
    const one = new uPlot(
      options(element, now.current, () => now.current.marks ?? []),
      drawable(now.current.data),
      element,
    );
    plot.current = one;
    one.over.addEventListener('click', (event) => now.current.onPick?.(one.posToVal(event.offsetX, 'x')));
    const watch = new ResizeObserver(() =>
      one.setSize({ width: Math.max(100, element.clientWidth), height: Math.max(80, element.clientHeight) }),
    );
    watch.observe(element);
    return () => {
      watch.disconnect();
      one.destroy();
      plot.current = null;
    };
  }, [made]);
  useEffect(() => plot.current?.setData(drawable(props.data)), [props.data]);
  useEffect(() => plot.current?.redraw(false, true), [marks]);
  return (
    <div
      ref={box}
      class="chart"
      style={props.height === undefined ? undefined : { height: `${props.height}px` }}
      role="img"
      aria-label={props.label}
    />
  );
}

/** Names of the lines. */
export function Legend({
  names,
  values,
}: {
  names: readonly string[];
  values?: readonly (string | null)[];
}): JSX.Element {
  return (
    <ul class="linelegend">
      {names.map((name, i) => (
        <li key={name}>
          <svg width="26" height="8" aria-hidden="true">
            <path
              class={`line-${(i % LINES) + 1}`}
              d="M1 4h24"
              stroke-width="2.4"
              stroke-dasharray={dashOf(i).join(' ')}
            />
          </svg>
          <code>{name}</code>
          {values?.[i] != null && <span class="tabular">{values[i]}</span>}
        </li>
      ))}
    </ul>
  );
}
