// Feed and rapid overrides: a slider, its value, and reset to 100 %.
import type { JSX } from 'preact';
import { mayOperate, notice, command } from '../link/commands';
import { status } from '../link/state';
import { percent } from '../parts/numbers';
import { Button, Panel } from '../parts/ui';

function Override(props: { name: 'feed' | 'rapid'; label: string; max: number }): JSX.Element {
  const value = status.value?.overrides[props.name] ?? 1;
  const why = mayOperate();
  const set = (part: number): void =>
    why === '' ? void command('set_overrides', { [props.name]: part }) : notice('refused', why);
  return (
    <div class="override">
      <span class="name">{props.label}</span>
      <input
        type="range"
        min="0"
        max={props.max * 100}
        step="5"
        value={Math.round(value * 100)}
        disabled={why !== ''}
        aria-label={`${props.label} override, %`}
        title={why || undefined}
        onInput={(event) => set(Number(event.currentTarget.value) / 100)}
      />
      <output class="tabular">{percent(value)}</output>
      <Button why={why} onClick={() => set(1)} label={`${props.label} override 100 %`}>
        100 %
      </Button>
    </div>
  );
}

export function Overrides(): JSX.Element {
  return (
    <Panel title="Overrides" class="overrides">
      <Override name="feed" label="Feed" max={2} />
      <Override name="rapid" label="Rapid" max={1} />
    </Panel>
  );
}
