// Path in two axes on a canvas: travel as a box, the planned line, the actual line coloured by error, the tool.
import { useSignalEffect } from '@preact/signals';
import type { JSX } from 'preact';
import { useCallback, useEffect, useRef } from 'preact/hooks';
import * as state from '../link/state';
import { dark } from '../view';
import { css, errorColour, STEPS_SHOWN } from './colours';
import { driven, maxError, planned } from './data';
import { boxAround, MARGIN, niceStep, sightOf, travelBox, type Box, type Sight } from './sight';

/** Displayed part of the machine: the whole travel, or the surroundings of the path. */
function bounds(a: number, b: number, fit: boolean): Box {
  const whole = travelBox(state.axes.peek()[a], state.axes.peek()[b]);
  if (!fit) return whole;
  return boxAround([...planned.peek(), ...driven.peek().map((one) => one.place)], a, b) ?? whole;
}

interface Ink {
  grid: string;
  box: string;
  text: string;
  plan: string;
  tool: string;
}

function inks(element: HTMLElement): Ink {
  const style = getComputedStyle(element);
  const get = (name: string): string => style.getPropertyValue(name).trim();
  return { grid: get('--line'), box: get('--muted'), text: get('--muted'), plan: get('--plan'), tool: get('--amber') };
}

class Painter {
  constructor(
    private readonly pen: CanvasRenderingContext2D,
    private readonly width: number,
    private readonly height: number,
    private readonly sight: Sight,
    private readonly ink: Ink,
  ) {}

  x(value: number): number {
    return this.sight.left + value * this.sight.scale;
  }
  y(value: number): number {
    return this.sight.top - value * this.sight.scale;
  }

  grid(unit: string): void {
    const { pen, ink, sight } = this;
    const step = niceStep(56 / sight.scale);
    pen.strokeStyle = ink.grid;
    pen.fillStyle = ink.text;
    pen.lineWidth = 1;
    pen.font = '11px Inter Variable, sans-serif';
    const decimals = Math.max(0, -Math.floor(Math.log10(step)));
    pen.beginPath();
    pen.textAlign = 'center';
    for (let v = Math.ceil((0 - sight.left) / sight.scale / step) * step; this.x(v) < this.width; v += step) {
      pen.moveTo(Math.round(this.x(v)) + 0.5, 0);
      pen.lineTo(Math.round(this.x(v)) + 0.5, this.height);
      if (this.x(v) > MARGIN) pen.fillText(v.toFixed(decimals), this.x(v), this.height - 6);
    }
    pen.textAlign = 'left';
    for (let v = Math.ceil((sight.top - this.height) / sight.scale / step) * step; this.y(v) > 0; v += step) {
      pen.moveTo(0, Math.round(this.y(v)) + 0.5);
      pen.lineTo(this.width, Math.round(this.y(v)) + 0.5);
      if (this.y(v) < this.height - 20) pen.fillText(v.toFixed(decimals), 5, this.y(v) - 4);
    }
    pen.stroke();
    pen.textAlign = 'right';
    pen.fillText(unit, this.width - 8, 16);
  }

  limits(a: { min: number; max: number } | undefined, b: { min: number; max: number } | undefined): void {
    if (a === undefined) return;
    const { pen } = this;
    pen.strokeStyle = this.ink.box;
    pen.lineWidth = 1.5;
    pen.setLineDash([7, 5]);
    pen.strokeRect(
      this.x(a.min),
      this.y(b?.max ?? 1),
      (a.max - a.min) * this.sight.scale,
      ((b?.max ?? 1) - (b?.min ?? 0)) * this.sight.scale,
    );
    pen.setLineDash([]);
  }

  line(points: readonly number[][], a: number, b: number): void {
    const { pen } = this;
    pen.strokeStyle = this.ink.plan;
    pen.lineWidth = 1.2;
    pen.beginPath();
    points.forEach((point, i) =>
      i === 0
        ? pen.moveTo(this.x(point[a] ?? 0), this.y(point[b] ?? 0))
        : pen.lineTo(this.x(point[a] ?? 0), this.y(point[b] ?? 0)),
    );
    pen.stroke();
  }

  /** Draws segments of equal colour as one stroke. */
  driven(a: number, b: number, isDark: boolean): void {
    const { pen } = this;
    const points = driven.peek();
    const max = maxError.peek();
    pen.lineWidth = 2.4;
    pen.lineJoin = pen.lineCap = 'round';
    let colour = -1;
    for (let i = 1; i < points.length; ++i) {
      const from = points[i - 1];
      const to = points[i];
      if (from === undefined || to === undefined) continue;
      const step = Math.round((to.error / max) * STEPS_SHOWN);
      if (step !== colour) {
        if (colour >= 0) pen.stroke();
        colour = step;
        pen.strokeStyle = css(errorColour(step / STEPS_SHOWN, isDark));
        pen.beginPath();
        pen.moveTo(this.x(from.place[a] ?? 0), this.y(from.place[b] ?? 0));
      }
      pen.lineTo(this.x(to.place[a] ?? 0), this.y(to.place[b] ?? 0));
    }
    if (colour >= 0) pen.stroke();
  }

  tool(x: number, y: number): void {
    const { pen } = this;
    const [px, py] = [this.x(x), this.y(y)];
    pen.strokeStyle = this.ink.tool;
    pen.lineWidth = 2;
    pen.beginPath();
    pen.arc(px, py, 6, 0, 2 * Math.PI);
    pen.moveTo(px - 12, py);
    pen.lineTo(px - 3, py);
    pen.moveTo(px + 3, py);
    pen.lineTo(px + 12, py);
    pen.moveTo(px, py - 12);
    pen.lineTo(px, py - 3);
    pen.moveTo(px, py + 3);
    pen.lineTo(px, py + 12);
    pen.stroke();
  }
}

function paint(canvas: HTMLCanvasElement, a: number, b: number, fit: boolean): void {
  const ratio = devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  const pen = canvas.getContext('2d');
  if (pen === null || width === 0) return;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  const painter = new Painter(pen, width, height, sightOf(bounds(a, b, fit), width, height), inks(canvas));
  const axes = state.axes.peek();
  painter.grid(axes[a]?.unit ?? '');
  painter.limits(axes[a], axes[b]);
  painter.line(planned.peek(), a, b);
  painter.driven(a, b, dark.peek());
  painter.tool(axes[a]?.actual ?? 0, axes[b]?.actual ?? 0);
}

/** `a`, `b`: indices of the axes in the list of axes. `fit`: shows the surroundings of the path. */
export function Flat({ a, b, fit, label }: { a: number; b: number; fit: boolean; label: string }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const wanted = useRef(false);
  const draw = useCallback((): void => {
    if (wanted.current) return;
    wanted.current = true;
    requestAnimationFrame(() => {
      wanted.current = false;
      if (canvas.current !== null) paint(canvas.current, a, b, fit);
    });
  }, [a, b, fit]);
  useSignalEffect(() => {
    void [planned.value, driven.value, state.status.value, dark.value];
    draw();
  });
  useEffect(() => {
    draw();
    const watch = new ResizeObserver(draw);
    if (canvas.current !== null) watch.observe(canvas.current);
    return () => watch.disconnect();
  }, [draw]);
  return <canvas ref={canvas} class="flat" role="img" aria-label={label} />;
}
