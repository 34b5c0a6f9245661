// Manual calls of a card's library functions: the list, a form for the selected function, the calls with their answers.
// Generated from the declaration sent by the program; independent of the card type.
import { signal, useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { mayMaintain, notice, query, sentence } from '../link/commands';
import type { CardInfo } from '../link/rack';
import { ask } from '../link/socket';
import { link, machineState, status } from '../link/state';
import { Icon } from '../parts/icons';
import { Button, Choice, Empty, Field, Panel, Select } from '../parts/ui';
import {
  callText,
  groupsOf,
  rangeText,
  readTexts,
  startsOf,
  turned,
  type ArgumentInfo,
  type FunctionInfo,
  type Texts,
} from './functions';

const KEPT = 100;
/** Functions that wait, e.g. for homing, answer when they end. */
const GIVE_UP_MS = 700_000;

interface Line {
  text: string;
  answer: string;
  bad: boolean;
}

/** Calls of each card, newest first; kept while the page is open. */
const calls = signal<Record<string, Line[]>>({});
/** Typed texts by card and function. */
const typedTexts = signal<Record<string, Texts>>({});

function note(card: string, line: Line): void {
  calls.value = { ...calls.value, [card]: [line, ...(calls.value[card] ?? [])].slice(0, KEPT) };
}

/** Sends a command and adds its sentence to the calls. */
async function give(card: string, text: string, command: string, fields: Record<string, unknown>): Promise<void> {
  try {
    const reply = await ask({ ...fields, command }, GIVE_UP_MS);
    note(card, { text, answer: typeof reply.text === 'string' ? reply.text : 'done', bad: false });
  } catch (why) {
    note(card, { text, answer: sentence(why), bad: true });
    notice('refused', sentence(why));
  }
}

const inService = (card: CardInfo): boolean => status.value?.service === card.name;

/** Reason why the service cannot start; empty: it can. */
function mayBegin(card: CardInfo): string {
  const [why, other] = [mayMaintain(), status.value?.service ?? ''];
  if (why !== '') return why;
  if (other !== '') return `Card ${other} is in service. End that first.`;
  const stands = machineState.value === 'standstill' || (card.axes.length === 0 && machineState.value === 'disabled');
  return stands ? '' : 'The service begins while the machine is enabled and stands still.';
}

/** Reason why a function cannot be called; empty: it can. Without machine axes, the first call starts the service. */
function mayCall(card: CardInfo): string {
  const why = mayMaintain();
  if (why !== '' || inService(card)) return why;
  return card.axes.length > 0 ? 'Begin the service of this card first.' : mayBegin(card);
}

function Service({ card }: { card: CardInfo }): JSX.Element {
  const on = inService(card);
  return (
    <Button
      machine
      kind={on ? 'main' : 'plain'}
      icon={on ? 'close' : 'hand'}
      why={on ? mayMaintain() : mayBegin(card)}
      onClick={() =>
        void give(card.name, on ? 'end the service' : 'begin the service', 'service', { card: card.name, on: !on })
      }>
      {on ? 'End service' : 'Begin service'}
    </Button>
  );
}

function Sum(props: { argument: ArgumentInfo; value: string; onChange: (value: string) => void }): JSX.Element {
  const sum = Number(props.value) || 0;
  return (
    <div class="choice" role="group" aria-label={`${props.argument.name}: ${props.argument.meaning}`}>
      {props.argument.values.map((one) => (
        <Button
          key={one.value}
          pressed={(sum & one.value) === one.value}
          onClick={() => props.onChange(String(turned(sum, one.value)))}>
          {one.meaning}
        </Button>
      ))}
    </div>
  );
}

function Argument(props: {
  argument: ArgumentInfo;
  value: string;
  onChange: (value: string) => void;
  onEnter: () => void;
}): JSX.Element {
  const { argument, value, onChange } = props;
  const options = argument.values.map((one) => ({ value: String(one.value), text: one.meaning }));
  const entry = argument.sum ? (
    <Sum argument={argument} value={value} onChange={onChange} />
  ) : options.length > 4 ? (
    <Select label={argument.name} value={value} onChange={onChange} options={options} />
  ) : options.length > 0 ? (
    <Choice label={`${argument.name}: ${argument.meaning}`} value={value} onChange={onChange} options={options} />
  ) : (
    <Field label={argument.name} value={value} unit={argument.unit} onInput={onChange} onEnter={props.onEnter} />
  );
  return (
    <div class="argument">
      {options.length > 0 && (argument.sum || options.length <= 4) && <span class="name">{argument.name}</span>}
      {entry}
      <p class="hint">
        {argument.meaning}
        {options.length === 0 && `; ${rangeText(argument)}`}
      </p>
    </div>
  );
}

function Form({ card, one }: { card: CardInfo; one: FunctionInfo }): JSX.Element {
  const key = `${card.name}.${one.name}`;
  const texts = { ...startsOf(one), ...typedTexts.value[key] };
  const working = useSignal(false);
  const set = (name: string, text: string): void =>
    void (typedTexts.value = { ...typedTexts.value, [key]: { ...texts, [name]: text } });
  const why = working.value ? 'The previous call has not ended.' : mayCall(card);
  const call = async (): Promise<void> => {
    const read = readTexts(one, texts);
    if (why !== '' || read.values === undefined) {
      notice('refused', why !== '' ? why : (read.why ?? ''));
      return;
    }
    working.value = true;
    await give(card.name, callText(one.name, read.values), 'call', {
      card: card.name,
      function: one.name,
      arguments: read.values,
    });
    working.value = false;
  };
  return (
    <form class="call" aria-label={one.name} onSubmit={(event) => event.preventDefault()}>
      <h3>
        <code>{one.name}</code>
      </h3>
      <p>
        {one.meaning}
        {one.returns !== '' && ` Returns ${one.returns}.`}
        {one.waits && ' Waits until it has ended; STOP ends it at once.'}
      </p>
      <div class="arguments">
        {one.arguments.map((argument) => (
          <Argument
            key={argument.name}
            argument={argument}
            value={texts[argument.name] ?? ''}
            onChange={(text) => set(argument.name, text)}
            onEnter={() => void call()}
          />
        ))}
      </div>
      <Button machine kind="main" icon="run" why={why} onClick={() => void call()}>
        {working.value ? 'Works …' : `Call ${one.name}`}
      </Button>
    </form>
  );
}

function List(props: {
  functions: readonly FunctionInfo[];
  chosen: string;
  onChoose(name: string): void;
}): JSX.Element {
  const search = useSignal('');
  const groups = groupsOf(props.functions, search.value);
  return (
    <div class="functionlist">
      <Field
        label="Search functions"
        wide
        value={search.value}
        placeholder="name, group or word"
        onInput={(text) => (search.value = text)}
      />
      <div class="scroll" role="region" aria-label="List of functions" tabIndex={0}>
        {groups.length === 0 && <Empty>No function has these words.</Empty>}
        {groups.map((group) => (
          <div key={group.name} role="group" aria-label={group.name}>
            <h3>{group.name}</h3>
            {group.functions.map((one) => (
              <button
                key={one.name}
                type="button"
                title={one.meaning}
                aria-pressed={one.name === props.chosen}
                onClick={() => props.onChoose(one.name)}>
                {one.name}
              </button>
            ))}
          </div>
        ))}
      </div>
    </div>
  );
}

function Calls({ card }: { card: CardInfo }): JSX.Element {
  const lines = calls.value[card.name] ?? [];
  return (
    <div class="log" role="log" aria-label="Calls" tabIndex={0}>
      {lines.length === 0 && <Empty>The calls of this page and their results, the newest first.</Empty>}
      {lines.map((line, i) => (
        <p key={lines.length - i} class={line.bad ? 'bad' : ''}>
          <code>{line.text}</code>
          <span class="tabular">
            {line.bad && <Icon name="alarm" size={14} />}
            {line.answer}
          </span>
        </p>
      ))}
    </div>
  );
}

export function Functions({ card }: { card: CardInfo }): JSX.Element {
  const functions = useSignal<FunctionInfo[]>([]);
  const chosen = useSignal('');
  const open = link.value === 'open';
  useEffect(() => {
    if (!open) return;
    query<{ functions: FunctionInfo[] }>('library', { name: card.name }).then(
      (answer) => (functions.value = answer.functions),
      (why: unknown) => notice('refused', sentence(why)),
    );
  }, [card.name, open, functions]);
  const one = functions.value.find((each) => each.name === chosen.value) ?? functions.value[0];
  const told = inService(card)
    ? card.live !== null
      ? 'A real card is in service: its functions move its motors. STOP stops all its axes at once.'
      : 'In service: the controller drives nothing. STOP and every switch stop all axes at once and end the service.'
    : card.axes.length > 0
      ? `The controller drives ${card.axes.map((axis) => axis.letter).join(', ')} with this card. Service disconnects the ` +
        'controller, resets the card and invalidates its positions. Home afterwards.'
      : `${card.live === null ? '' : 'A real card. '}No axis of the machine is on this card: the first call begins its service, and resets the card.`;
  return (
    <Panel title="Functions of its library" class="wide functions" note={told} tools={<Service card={card} />}>
      {one === undefined ? (
        <Empty>Loading the functions.</Empty>
      ) : (
        <div class="functioncolumns">
          <List functions={functions.value} chosen={one.name} onChoose={(name) => (chosen.value = name)} />
          <div class="column">
            <Form key={one.name} card={card} one={one} />
            <Calls card={card} />
          </div>
        </div>
      )}
    </Panel>
  );
}
