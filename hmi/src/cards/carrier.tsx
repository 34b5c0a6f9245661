// Belt, table or stage: its position, and the button that restarts it after a stop.
import type { JSX } from 'preact';
import { mayOperate, command } from '../link/commands';
import { fixed, unitName } from '../parts/numbers';
import { Button } from '../parts/ui';

export interface CarrierState {
  name: string;
  unit: string;
  position: number;
  velocity: number;
  stopped: boolean;
}

export function Carrier({ part }: { part: CarrierState }): JSX.Element {
  const unit = unitName(part.unit);
  return (
    <div>
      <dt>{part.name}</dt>
      <dd class="tabular">
        {fixed(part.position, 2)} {unit}, {fixed(part.velocity, 1)} {unit}/s{' '}
        {part.stopped && (
          <Button why={mayOperate()} icon="run" onClick={() => void command('start_part', { part: part.name })}>
            Start {part.name}
          </Button>
        )}
      </dd>
    </div>
  );
}
