// Clock of the rack: real time, scaled, unthrottled, paused and stepped; the simulated emergency stop.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { actions } from '../actions';
import { mayMaintain, notice, command } from '../link/commands';
import { status } from '../link/state';
import { fixed, typed } from '../parts/numbers';
import { ActionButton, Button, Choice, Field, Panel } from '../parts/ui';

/** Modes by name, time scales as numbers. */
const MODES = [
  { value: 'paused', text: 'Pause' },
  ...[0.1, 0.5, 1, 2, 10].map((one) => ({ value: String(one), text: one === 1 ? 'Real' : `${one} ×` })),
  { value: 'unthrottled', text: 'Unthrottled' },
];

export function Clock(): JSX.Element {
  const clock = status.value?.clock;
  const step = useSignal('0.002');
  const why = mayMaintain();
  const set = (mode: string): void => {
    if (mode === 'unthrottled' || mode === 'paused') void command('set_clock', { mode });
    else void command('set_clock', { mode: 'real', factor: Number(mode) });
  };
  const stepBy = (): void => {
    const seconds = typed(step.value);
    if (seconds === null || seconds <= 0)
      notice(
        'refused',
        `The clock cannot be stepped by "${step.value}"; a number of seconds above 0 is needed. Nothing was done.`,
      );
    else void command('advance_clock', { duration_s: seconds });
  };
  const now = clock === undefined ? '' : clock.mode === 'real' ? String(clock.factor) : clock.mode;
  return (
    <Panel
      title="Clock and E-stop input"
      class="clockpanel"
      tools={<span class="tabular">{fixed(status.value?.at, 3)} s</span>}>
      <Choice label="Clock" value={now} onChange={set} options={MODES.map((one) => ({ ...one, why }))} />
      <div class="row">
        <Field
          label="Step"
          value={step.value}
          unit="s"
          mode="decimal"
          onInput={(text) => (step.value = text)}
          onEnter={stepBy}
        />
        <Button icon="step" why={why || (clock?.mode === 'paused' ? '' : 'Pause the clock first.')} onClick={stepBy}>
          Step
        </Button>
        <ActionButton action={actions.estop} icon="power" machine={false}>
          {status.value?.estop.pressed ? 'Release E-stop' : 'Press E-stop'}
        </ActionButton>
      </div>
      {clock?.mode === 'real' && <p class="hint tabular">behind by {fixed(clock.late_ms, 1)} ms</p>}
    </Panel>
  );
}
