// Panel of the DataBoard 4002: commands with handshake, manual port access, status and events, the slope as a chart.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import uPlot from 'uplot';
import { notice, commandFor, query, sentence } from '../link/commands';
import type { CardInfo, CommandInfo } from '../link/rack';
import { fixed, typed, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Button, Empty, Field, Panel } from '../parts/ui';
import { Chart, Legend } from '../scope/chart';
import { Console, mayAccess } from './console';
import { ask, choose, give, Turns, type Bus, type Exchanged, type Shown } from './handshake';
import { LiveCard } from './live_card';
import { Flags, Quantities, valueOf, wordOf, type CardAnswer } from './peek';
import { analogOutputs } from './words';

interface SlopesAnswer {
  /** Velocity in Hz over counts. */
  slopes: { name: string; points: [number, number][] }[];
  moving: boolean;
  hz: number;
}

/** Both halves of the table over one list of counts. */
const curves = (slopes: SlopesAnswer['slopes']): (number | null)[][] =>
  slopes.length === 0
    ? []
    : uPlot
        .join(
          slopes.map(
            (slope) => [slope.points.map(([at]) => at), slope.points.map(([, hz]) => hz)] as uPlot.AlignedData,
          ),
        )
        .map((row) => [...(row as (number | null | undefined)[])].map((value) => value ?? null));

function Slope({ card }: { card: CardInfo }): JSX.Element {
  const { data, why } = usePoll<SlopesAnswer>('slopes', { name: card.name }, 2000);
  const names = (data.value?.slopes ?? []).map((slope) => slope.name);
  // Redrawn when the table changes, not at every query.
  const table = JSON.stringify(data.value?.slopes ?? []);
  const picture = useMemo(() => curves(JSON.parse(table) as SlopesAnswer['slopes']), [table]);
  const loaded = (picture[0]?.length ?? 0) > 1;
  return (
    <Panel title="Slope" class="slope">
      {!loaded ? (
        <Empty>{why.value || 'No slope has been loaded into the card (command S).'}</Empty>
      ) : (
        <>
          <Chart
            data={picture}
            names={names}
            xName="counts"
            label="Slope table: speed in Hz over the way in counts"
            height={240}
          />
          <Legend names={names} />
          <p class="hint tabular">
            Hz over counts; {data.value?.moving === true ? `it moves at ${fixed(data.value.hz, 0)} Hz` : 'it stands'}
          </p>
        </>
      )}
    </Panel>
  );
}

/** Longer arguments are tables, for programs. */
const MAX_BYTES = 4;

/** Asks for the card's number and its CSB; null if rejected, with the sentence on the screen. */
async function shownBy(card: CardInfo): Promise<Shown | null> {
  try {
    const answer = await query<CardAnswer>('card', { name: card.name });
    const select = valueOf(answer, 'SELECT');
    if (select === null) notice('refused', `${card.name} does not tell its number (SELECT). Nothing was sent.`);
    return { csb: answer.pins.csb, select };
  } catch (why) {
    notice('refused', sentence(why));
    return null;
  }
}

/** Ports by name; DATA is written as OUT and read as INP. */
function busOf(card: CardInfo): Bus {
  const port = (name: string): number =>
    card.bus.base +
    (card.registers.find((one) => one.name === name || (name === 'DATA' && one.name === 'OUT'))?.offset ?? 0);
  const write = async (name: string, value: number): Promise<boolean> =>
    (await commandFor('write_register', { card: card.name, bits: 8, address: port(name), value })) !== null;
  return {
    choose: () => choose(() => shownBy(card), write),
    read: async (name) =>
      ((await commandFor('read_register', { card: card.name, bits: 8, address: port(name) }))?.value as
        number | undefined) ?? null,
    write,
    rest: () => new Promise((done) => setTimeout(done, 5)),
  };
}

function Command(props: { bus: Bus; turns: Turns; command: CommandInfo; why: string }): JSX.Element {
  const { bus, turns, command, why } = props;
  const argument = useSignal('');
  const answer = useSignal<number | null>(null);
  const told = (outcome: Exchanged): void => {
    if ('value' in outcome) answer.value = outcome.value;
    else if (outcome.why !== '') notice('refused', outcome.why);
  };
  const send = (): void => {
    const value = command.data_bytes === 0 ? 0 : typed(argument.value);
    if (value === null || !Number.isInteger(value) || value < command.min || value > command.max)
      notice(
        'refused',
        `The argument is "${argument.value}"; it must be ${whole(command.min)} to ${whole(command.max)}. Nothing was sent.`,
      );
    else void turns.take(() => give(bus, command, value)).then(told);
  };
  const reads = command.answer_bytes > 0;
  return (
    <tr>
      <th scope="row">
        <code>{command.name}</code>
      </th>
      <td class="meaning">{command.meaning}</td>
      <td>
        {command.data_bytes > 0 && (
          <Field
            label={`Argument of ${command.name}`}
            value={argument.value}
            unit={command.unit}
            mode="text"
            onEnter={() => why === '' && send()}
            onInput={(text) => (argument.value = text)}
          />
        )}
      </td>
      <td>
        <span class="buttons">
          {(command.data_bytes > 0 || !reads) && (
            <Button why={why} label={`Send ${command.name}`} onClick={send}>
              Send
            </Button>
          )}
          {reads && (
            <Button
              why={why}
              label={`Ask ${command.name}`}
              onClick={() => void turns.take(() => ask(bus, command)).then(told)}>
              Ask
            </Button>
          )}
        </span>
      </td>
      <td class="tabular">{answer.value === null ? '' : whole(answer.value)}</td>
    </tr>
  );
}

/** One row per command. */
function Commands({ card }: { card: CardInfo }): JSX.Element {
  const why = mayAccess(card);
  const bus = busOf(card);
  const turns = useMemo(() => new Turns(), []);
  return (
    <Panel title="Commands" class="wide">
      <div class="scroll" tabIndex={0} role="region" aria-label="Commands of the card">
        <table class="counters">
          <thead>
            <tr>
              {['Command', 'Meaning', 'Argument', 'Do', 'Answer'].map((head) => (
                <th key={head} scope="col">
                  {head}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {card.commands
              .filter((one) => one.data_bytes <= MAX_BYTES)
              .map((one) => (
                <Command key={one.name} bus={bus} turns={turns} command={one} why={why} />
              ))}
          </tbody>
        </table>
      </div>
    </Panel>
  );
}

/** A real card: its status, position and rate. */
function LiveDataboard({ card, place }: { card: CardInfo; place: string }): JSX.Element {
  const stat = card.registers.find((one) => one.name === 'STAT');
  return (
    <LiveCard card={card} place={place}>
      {(seen) => (
        <>
          {stat !== undefined && <Flags register={stat} word={wordOf(seen, 'STAT')} />}
          <p class="tabular">
            Position {whole(valueOf(seen, 'POSITION'))} counts, rate {whole(valueOf(seen, 'RATE'))}
          </p>
        </>
      )}
    </LiveCard>
  );
}

function VirtualDataboard({ card }: { card: CardInfo }): JSX.Element {
  const { data, why } = usePoll<CardAnswer>('card', { name: card.name }, 200);
  const shown = card.registers.filter((one) => ['STAT', 'EVENT'].includes(one.name));
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        {shown.map((one) => (
          <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />
        ))}
        <p class="tabular">
          Rate {whole(valueOf(data.value, 'RATE'))}, {analogOutputs(data.value?.pins)}
        </p>
        {why.value !== '' && <p class="hint">{why.value}</p>}
        <Quantities card={card} />
      </Panel>
      <Commands card={card} />
      <Panel title="Ports" class="ports">
        <Console card={card} />
      </Panel>
      <Slope card={card} />
    </>
  );
}

export function Databoard({ card }: { card: CardInfo }): JSX.Element {
  return card.live === null ? <VirtualDataboard card={card} /> : <LiveDataboard card={card} place={card.live} />;
}
