// Homing: the phase of each axis, and the results afterwards.
import { signal, useSignalEffect } from '@preact/signals';
import type { JSX } from 'preact';
import { query } from '../link/commands';
import * as state from '../link/state';
import { Icon } from '../parts/icons';
import { fixed, unitName } from '../parts/numbers';

interface HomedAxis {
  axis: string;
  unit: string;
  homed: boolean;
  seconds: number;
  sentence: string;
  states: { state: string; took_s: number; from: number; to: number }[];
}
interface Report {
  homed: boolean;
  error: string | null;
  axes: HomedAxis[];
}

const report = signal<Report | null>(null);

function look(): void {
  if (state.machineState.value === 'homing' || state.link.value !== 'open') return;
  query<{ homing: Report | null }>('homing').then(
    (answer) => (report.value = answer.homing),
    () => undefined,
  );
}

const plain = (name: string): string => name.replace(/_WAIT$/, '').toLowerCase();

function Phases(): JSX.Element {
  return (
    <ul class="phases" aria-label="Phases of homing">
      {Object.entries(state.status.value?.homing?.phases ?? {}).map(([axis, phase]) => (
        <li key={axis}>
          <strong>{axis}</strong> {plain(phase)}
        </li>
      ))}
    </ul>
  );
}

function Found({ axis }: { axis: HomedAxis }): JSX.Element {
  const unit = unitName(axis.unit);
  return (
    <section>
      <p class={axis.homed ? 'found' : 'found bad'}>
        <Icon name={axis.homed ? 'check' : 'alarm'} size={15} />
        <strong>{axis.axis}</strong> {axis.sentence} <span class="tabular">{fixed(axis.seconds, 3)} s</span>
      </p>
      <table>
        <thead>
          <tr>
            {['Phase', 's', `from, ${unit}`, `to, ${unit}`].map((head) => (
              <th key={head} scope="col">
                {head}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {axis.states.map((one, i) => (
            <tr key={i}>
              <td>{plain(one.state)}</td>
              <td class="tabular">{fixed(one.took_s, 3)}</td>
              <td class="tabular">{fixed(one.from, 4)}</td>
              <td class="tabular">{fixed(one.to, 4)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

export function Homing(): JSX.Element | null {
  useSignalEffect(look);
  if (state.machineState.value === 'homing') return <Phases />;
  const last = report.value;
  if (last === null) return null;
  return (
    <details class="homing">
      <summary>{last.homed ? 'Homed; results' : 'The last homing failed'}</summary>
      {last.error !== null && <p class="why">{last.error}</p>}
      {last.axes.map((axis) => (
        <Found key={axis.axis} axis={axis} />
      ))}
    </details>
  );
}
