// The DataBoard 4002's panel: its ports by hand, status and events, the slope as a picture.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import uPlot from 'uplot';
import type { CardInfo } from '../link/rack';
import { fixed } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Chart, Legend } from '../scope/chart';
import { Console } from './console';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface SlopesAnswer {
  /** Speed in Hz over counts. */
  slopes: { name: string; points: [number, number][] }[];
  moving: boolean;
  hz: number;
}

/** Both halves of the table over one list of places. */
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
  // Drawn anew when the table changes, not whenever it is asked for.
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

export function Databoard({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 200);
  const shown = card.registers.filter((one) => ['STAT', 'EVENT'].includes(one.name));
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        {shown.map((one) => (
          <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />
        ))}
        <Quantities card={card} />
      </Panel>
      <Panel title="Ports" class="ports">
        <Console card={card} />
      </Panel>
      <Slope card={card} />
    </>
  );
}
