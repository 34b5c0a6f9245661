// The scope: channels, trigger, what comes before it; run, single, stop; two cursors; export.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { notice, order, whyNot } from '../link/orders';
import { fixed, typed } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Button, Empty, Field, Panel, Select } from '../parts/ui';
import { Chart, Legend } from './chart';
import { Picker } from './picker';
import { keep, recorded, type ScopeAnswer } from './recorded';

const MOST = 16;
const KEY = 'motionrack.scope';

interface Settings {
  channels: string[];
  trigger: string;
  edge: string;
  level: string;
  /** us */
  period: string;
  /** ms */
  length: string;
  /** ms */
  pre: string;
}

const EMPTY: Settings = {
  channels: [],
  trigger: '',
  edge: 'rise',
  level: '0.5',
  period: '100',
  length: '100',
  pre: '20',
};
const settings = signal<Settings>({
  ...EMPTY,
  ...(JSON.parse(localStorage.getItem(KEY) ?? '{}') as Partial<Settings>),
});
const cursors = signal<[number, number]>([0, 0]);
const moving = signal<0 | 1>(0);

function set(part: Partial<Settings>): void {
  settings.value = { ...settings.value, ...part };
  localStorage.setItem(KEY, JSON.stringify(settings.value));
}

function arm(mode: 'run' | 'single'): void {
  const now = settings.value;
  const [level, period_us, length, pre] = [now.level, now.period, now.length, now.pre].map(typed);
  if (level == null || period_us == null || length == null || pre == null) {
    notice('refused', 'Level and times must be numbers. The scope was not armed.');
    return;
  }
  const trigger = now.trigger === '' ? {} : { trigger: now.trigger, edge: now.edge, level };
  void order('scope_arm', {
    channels: now.channels,
    ...trigger,
    period_us,
    length: length / 1000,
    pre: pre / 1000,
    mode,
  });
}

/** A channel that did not change there has its value from before. */
function valueAt(values: (number | null)[], at: number): number | null {
  for (let i = at; i >= 0; --i) if (values[i] != null) return values[i] ?? null;
  return null;
}

function Cursors({ data, names }: { data: (number | null)[][]; names: readonly string[] }): JSX.Element {
  const times = data[0] ?? [];
  const index = (x: number): number => {
    let best = 0;
    times.forEach((time, i) => {
      if (Math.abs((time ?? 0) - x) < Math.abs((times[best] ?? 0) - x)) best = i;
    });
    return best;
  };
  const [a, b] = cursors.value.map(index) as [number, number];
  const move = (which: 0 | 1, i: number): void => {
    const next: [number, number] = [...cursors.value];
    next[which] = times[i] ?? 0;
    cursors.value = next;
  };
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
            onInput={(event) => move(which, Number(event.currentTarget.value))}
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
          {names.map((name, i) => {
            const [va, vb] = [valueAt(data[i + 1] ?? [], a), valueAt(data[i + 1] ?? [], b)];
            return (
              <tr key={name}>
                <td>
                  <code>{name}</code>
                </td>
                <td class="tabular">{fixed(va, 4)}</td>
                <td class="tabular">{fixed(vb, 4)}</td>
                <td class="tabular">{va === null || vb === null ? '–' : fixed(vb - va, 4)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

function save(names: readonly string[], data: (number | null)[][]): void {
  const rows = (data[0] ?? []).map((time, i) => [time, ...names.map((_, n) => data[n + 1]?.[i] ?? '')].join(','));
  const file = new Blob([['time_ms', ...names].join(',') + '\n' + rows.join('\n') + '\n'], { type: 'text/csv' });
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
export function Scope(): JSX.Element {
  const { data: answer } = usePoll<ScopeAnswer>('scope', { since: recorded.value.number }, 300);
  if (answer.value !== null) keep(answer.value);
  const { names, rows, stepped } = recorded.value;
  const why = whyNot('operate') || (settings.value.channels.length === 0 ? 'Choose a channel first.' : '');
  const now = settings.value;
  const pick = (x: number): void => {
    const next: [number, number] = [...cursors.value];
    next[moving.value] = x;
    cursors.value = next;
    moving.value = moving.value === 0 ? 1 : 0;
  };
  const times = rows[0] ?? [];
  // Where nobody has put them: at a third and two thirds.
  if (cursors.value[0] === cursors.value[1] && times.length > 3)
    cursors.value = [times[Math.floor(times.length / 3)] ?? 0, times[Math.floor((2 * times.length) / 3)] ?? 0];
  const marks = [
    { x: 0, name: 'T' },
    { x: cursors.value[0], name: 'A' },
    { x: cursors.value[1], name: 'B' },
  ];
  return (
    <div class="scopeview">
      <Panel
        title="Scope"
        class="scope"
        tools={
          <>
            <span class={`word ${answer.value?.state ?? 'idle'}`} role="status">
              {WORDS[answer.value?.state ?? 'idle'] ?? ''}
            </span>
            <Button icon="run" why={why} onClick={() => arm('run')}>
              Run
            </Button>
            <Button icon="step" why={why} onClick={() => arm('single')}>
              Single
            </Button>
            <Button icon="standstill" why={whyNot('operate')} onClick={() => void order('scope_stop')}>
              Stop
            </Button>
            <Button
              icon="save"
              why={names.length === 0 ? 'There is nothing recorded yet.' : ''}
              onClick={() => save(names, rows)}>
              CSV
            </Button>
          </>
        }>
        {names.length > 0 && (rows[0]?.length ?? 0) > 1 ? (
          <>
            <Chart
              data={rows}
              names={names}
              xName="ms"
              label={`Recording of ${names.join(', ')}`}
              marks={marks}
              stepped={(name) => stepped.includes(name)}
              onPick={pick}
            />
            <Legend names={names} />
            <Cursors data={rows} names={names} />
          </>
        ) : (
          <Empty>Choose channels, set a trigger, and press Run or Single. Without a trigger it records at once.</Empty>
        )}
      </Panel>
      <div class="column">
        <Panel title="Channels">
          <Picker chosen={now.channels} most={MOST} onChange={(channels) => set({ channels })} />
        </Panel>
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
          <Field
            label="Sample every"
            value={now.period}
            unit="us"
            mode="decimal"
            onInput={(period) => set({ period })}
          />
          <Field label="Length" value={now.length} unit="ms" mode="decimal" onInput={(length) => set({ length })} />
          <Field label="Before the trigger" value={now.pre} unit="ms" mode="decimal" onInput={(pre) => set({ pre })} />
        </Panel>
      </div>
    </div>
  );
}
