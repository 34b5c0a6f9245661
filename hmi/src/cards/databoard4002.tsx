// Panel of the DataBoard 4002: status and events, manual port access, the slope as a chart. Its commands are functions
// of its library.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import uPlot from 'uplot';
import type { CardInfo } from '../link/rack';
import { fixed, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Chart, Legend } from '../scope/chart';
import { Console } from './console';
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
            label="Slope table: speed in Hz over the distance in counts"
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

/** A real card: its status, position and rate. */
function LiveDataboard({ card, place }: { card: CardInfo; place: string }): JSX.Element {
  const stat = card.registers.find((one) => one.name === 'STAT');
  return (
    <LiveCard card={card} place={place}>
      {(seen) => (
        <>
          {stat !== undefined && <Flags register={stat} word={wordOf(seen, 'STAT')} />}
          <p class="tabular">
            Position {whole(valueOf(seen, 'POSITION'))} counts, rate {whole(valueOf(seen, 'RATE'))} (register value)
          </p>
          <p class="hint">While a function waits, STAT alone is read: position and rate are not known until it ends.</p>
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
          Rate {whole(valueOf(data.value, 'RATE'))} (register value), {analogOutputs(data.value?.pins)}
        </p>
        {why.value !== '' && <p class="hint">{why.value}</p>}
        <Quantities card={card} />
      </Panel>
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
