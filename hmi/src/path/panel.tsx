// Path view: flat in two axes, or in space on demand, with the error scale.
import { signal } from '@preact/signals';
import type { ComponentType, JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import * as state from '../link/state';
import { fixed } from '../parts/numbers';
import { Button, Choice, Panel } from '../parts/ui';
import { dark } from '../view';
import { css, errorColour } from './colours';
import { clearDriven, follow, maxError, letters, plannedIs } from './data';
import { Flat } from './flat';
import { planesOf } from './sight';

const plane = signal('XY');
const fit = signal(false);
const Space = signal<ComponentType | null>(null);

async function choose(to: string): Promise<void> {
  plane.value = to;
  if (to === '3D' && Space.value === null) Space.value = (await import('./space')).Space;
}

function Scale(): JSX.Element {
  const steps = [0, 0.25, 0.5, 0.75, 1];
  return (
    <div class="errorscale" title="Colour of the driven path: its error">
      <span>error 0</span>
      <svg width="90" height="10" aria-hidden="true">
        {steps.map((part, i) => (
          <rect key={part} x={i * 18} width="18" height="10" fill={css(errorColour(part, dark.value))} />
        ))}
      </svg>
      <span class="tabular">{fixed(maxError.value, 3)} mm</span>
    </div>
  );
}

const PLANNED = {
  none: 'no planned path',
  checked: 'planned: the checked program',
  running: 'planned: the running program',
};

export function Path(): JSX.Element {
  useEffect(follow, []);
  const { options, shown } = planesOf(letters.value, plane.value);
  const of = (i: number): number => state.axes.value.findIndex((axis) => axis.letter === shown[i]);
  return (
    <Panel
      title="Path"
      class="path"
      tools={
        <>
          <Choice
            label="Plane of the path"
            value={shown}
            onChange={(to) => void choose(to)}
            options={options.map((one) => ({ value: one, text: one }))}
          />
          <Button pressed={fit.value} onClick={() => (fit.value = !fit.value)}>
            Fit
          </Button>
          <Button onClick={clearDriven}>Clear</Button>
        </>
      }>
      <div class="sight">
        {shown === '3D' && Space.value !== null ? (
          <Space.value />
        ) : (
          <Flat
            a={Math.max(0, of(0))}
            b={of(1)}
            fit={fit.value}
            label={`Path in ${shown}: travel, planned and driven line`}
          />
        )}
      </div>
      <div class="legend">
        <span class="plan">{PLANNED[plannedIs.value]}</span>
        <span class="box">travel</span>
        <Scale />
      </div>
    </Panel>
  );
}
