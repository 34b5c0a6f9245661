// Fault injection, and manually forced wires.
import { computed, signal } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { mayMaintain, notice, commandFor } from '../link/commands';
import { rack } from '../link/rack';
import { fixed, typed } from '../parts/numbers';
import { Button, Empty, Field, Led, Panel, Select } from '../parts/ui';

interface Broken {
  target: string;
  fault: string;
  value: string;
}

/** Faults injected by this page and still active. */
const broken = signal<Broken[]>([]);
const target = signal('');
const value = signal('1');

async function inject(which: string, fault: string, amount: string): Promise<void> {
  if ((await commandFor('inject_fault', { target: which, fault: `${fault}=${amount}` })) === null) return;
  const others = broken.value.filter((one) => one.target !== which || one.fault !== fault);
  broken.value = typed(amount) === 0 ? others : [...others, { target: which, fault, value: amount }];
}

function Injection(): JSX.Element {
  const all = rack.value?.faults ?? [];
  const chosen = all.find((one) => one.target === target.value) ?? all[0];
  const why = mayMaintain();
  if (chosen === undefined) return <Empty>The rack has no faults to inject.</Empty>;
  const give = (fault: string): void => {
    if (typed(value.value) === null) notice('refused', `"${value.value}" is not a number. No fault was injected.`);
    else void inject(chosen.target, fault, String(typed(value.value)));
  };
  return (
    <>
      <div class="row">
        <Select
          label="Of"
          value={chosen.target}
          onChange={(to) => (target.value = to)}
          options={all.map((one) => ({ value: one.target, text: one.target }))}
        />
        <Field
          label="Value (1: on, 0: mended)"
          value={value.value}
          mode="decimal"
          onInput={(text) => (value.value = text)}
        />
      </div>
      <ul class="faultlist">
        {chosen.faults.map((fault) => {
          const on = broken.value.find((one) => one.target === chosen.target && one.fault === fault);
          return (
            <li key={fault}>
              <Led on={on !== undefined} letter="F" kind="warn" text={`${chosen.target} ${fault}`} />
              <code>{fault}</code>
              <span class="tabular">{on === undefined ? '' : on.value}</span>
              {on === undefined ? (
                <Button why={why} onClick={() => give(fault)}>
                  Break
                </Button>
              ) : (
                <Button why={why} onClick={() => void inject(chosen.target, fault, '0')}>
                  Mend
                </Button>
              )}
            </li>
          );
        })}
      </ul>
    </>
  );
}

const filter = signal('');
const driving = signal<Record<string, number>>({});
const MOST = 40;
const found = computed(() =>
  (rack.value?.wires ?? []).filter((wire) => wire.name.toLowerCase().includes(filter.value.toLowerCase())),
);

async function drive(name: string, level: number | null): Promise<void> {
  if ((await commandFor('set_wire', { name, value: level })) === null) return;
  const { [name]: _, ...others } = driving.value;
  driving.value = level === null ? others : { ...others, [name]: level };
}

function Wires(): JSX.Element {
  const shown = found.value.slice(0, MOST);
  const names = shown.map((wire) => wire.name).join(' ');
  useEffect(() => want(names === '' ? [] : names.split(' '), 10), [names]);
  const why = mayMaintain();
  return (
    <>
      <Field
        label="Find"
        value={filter.value}
        wide
        placeholder="limit, estop, xinp …"
        onInput={(text) => (filter.value = text)}
      />
      <ul class="wirelist">
        {shown.map((wire) => {
          const level = channel(wire.name).value;
          const no = why || (!wire.drivable ? 'An output drives this wire; it can only be read.' : '');
          const held = driving.value[wire.name];
          return (
            <li key={wire.name} class={held !== undefined ? 'held' : ''}>
              {wire.volts ? (
                <span class="volts tabular">{fixed(level, 3)} V</span>
              ) : (
                <Led on={level === 1} letter={level === null ? '–' : String(level)} text={wire.name} />
              )}
              <code>{wire.name}</code>
              {held !== undefined && <span class="by">by hand</span>}
              <span class="buttons">
                <Button why={no} label={`${wire.name} to 0`} onClick={() => void drive(wire.name, 0)}>
                  0
                </Button>
                <Button why={no} label={`${wire.name} to 1`} onClick={() => void drive(wire.name, 1)}>
                  1
                </Button>
                <Button
                  why={no || (held === undefined ? 'This wire is not forced from this page.' : '')}
                  label={`Release ${wire.name}`}
                  onClick={() => void drive(wire.name, null)}>
                  Release
                </Button>
              </span>
            </li>
          );
        })}
      </ul>
      {found.value.length > MOST && (
        <p class="hint">{found.value.length - MOST} more; type a part of a name to find them.</p>
      )}
    </>
  );
}

export function Faults(): JSX.Element {
  return (
    <div class="two">
      <Panel title="Break something on purpose" class="faults">
        <Injection />
      </Panel>
      <Panel title="Wires" class="wires">
        <Wires />
      </Panel>
    </div>
  );
}
