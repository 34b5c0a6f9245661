// Scope: channels, trigger and pre-trigger; run, single, stop; two cursors; export.
import type { JSX } from 'preact';
import { notice, command, whyNot } from '../link/commands';
import { usePoll } from '../parts/poll';
import { Button, Empty, Field, Panel, Select } from '../parts/ui';
import { Chart, Legend } from './chart';
import { Cursors, marksOf, pick } from './cursors';
import { Picker } from './picker';
import { csv, type Rows } from './reading';
import { keep, recorded, type ScopeAnswer } from './recorded';
import { armFields, MAX_CHANNELS, set, settings } from './settings';

function arm(mode: 'run' | 'single'): void {
  const fields = armFields(settings.value, mode);
  if (fields === null) notice('refused', 'Level and times must be numbers. The scope was not armed.');
  else void command('scope_arm', fields);
}

function save(names: readonly string[], rows: Rows): void {
  const file = new Blob([csv(names, rows)], { type: 'text/csv' });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = 'scope.csv';
  link.click();
  URL.revokeObjectURL(link.href);
}

const WORDS: Record<string, string> = {
  idle: 'stopped',
  armed: 'waits for its trigger',
  triggered: 'triggered, records',
  done: 'recorded',
};

function Tools({ state }: { state: string }): JSX.Element {
  const { names, rows } = recorded.value;
  const why = whyNot('operate') || (settings.value.channels.length === 0 ? 'Choose a channel first.' : '');
  return (
    <>
      <span class={`word ${state}`} role="status">
        {WORDS[state] ?? ''}
      </span>
      <Button icon="run" why={why} onClick={() => arm('run')}>
        Run
      </Button>
      <Button icon="step" why={why} onClick={() => arm('single')}>
        Single
      </Button>
      <Button icon="standstill" why={whyNot('operate')} onClick={() => void command('scope_stop')}>
        Stop
      </Button>
      <Button icon="save" why={names.length === 0 ? 'Nothing is recorded yet.' : ''} onClick={() => save(names, rows)}>
        CSV
      </Button>
    </>
  );
}

function Recording(): JSX.Element {
  const { names, rows, stepped } = recorded.value;
  const times = rows[0] ?? [];
  if (names.length === 0 || times.length < 2)
    return (
      <Empty>Choose channels, set a trigger, and press Run or Single. Without a trigger it records at once.</Empty>
    );
  return (
    <>
      <Chart
        data={rows}
        names={names}
        xName="ms"
        label={`Recording of ${names.join(', ')}`}
        marks={marksOf(times)}
        stepped={(name) => stepped.includes(name)}
        onPick={pick}
      />
      <Legend names={names} />
      <Cursors data={rows} names={names} />
    </>
  );
}

function Trigger(): JSX.Element {
  const now = settings.value;
  return (
    <Panel title="Trigger and time" class="trigger">
      <Select
        label="Trigger"
        value={now.trigger}
        onChange={(trigger) => set({ trigger })}
        options={[{ value: '', text: 'none' }, ...now.channels.map((name) => ({ value: name, text: name }))]}
      />
      <Select
        label="Edge"
        value={now.edge}
        onChange={(edge) => set({ edge })}
        options={['rise', 'fall', 'either'].map((one) => ({ value: one, text: one }))}
      />
      <Field label="Level" value={now.level} mode="decimal" onInput={(level) => set({ level })} />
      <Field label="Sample every" value={now.period} unit="us" mode="decimal" onInput={(period) => set({ period })} />
      <Field label="Length" value={now.length} unit="ms" mode="decimal" onInput={(length) => set({ length })} />
      <Field label="Before the trigger" value={now.pre} unit="ms" mode="decimal" onInput={(pre) => set({ pre })} />
    </Panel>
  );
}

export function Scope(): JSX.Element {
  const { data: answer } = usePoll<ScopeAnswer>('scope', { since: recorded.value.number }, 300);
  if (answer.value !== null) keep(answer.value);
  return (
    <div class="scopeview">
      <Panel title="Scope" class="scope" tools={<Tools state={answer.value?.state ?? 'idle'} />}>
        <Recording />
      </Panel>
      <div class="column">
        <Panel title="Channels">
          <Picker chosen={settings.value.channels} max={MAX_CHANNELS} onChange={(channels) => set({ channels })} />
        </Panel>
        <Trigger />
      </div>
    </div>
  );
}
