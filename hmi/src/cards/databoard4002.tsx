// The DataBoard 4002's panel: its ports by hand, status and events, the slope as a picture.
import type { JSX } from 'preact';
import type { CardInfo } from '../link/rack';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Chart, Legend } from '../scope/chart';
import { Console } from './console';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface SlopesAnswer {
  slopes?: { name: string; unit: string; points: [number, number][] }[];
}

/** Slopes of different times on one axis: each has its own points, the others none there. */
function joined(slopes: NonNullable<SlopesAnswer['slopes']>): (number | null)[][] {
  const times = [...new Set(slopes.flatMap((slope) => slope.points.map(([t]) => t)))].sort((a, b) => a - b);
  return [times, ...slopes.map((slope) => times.map((t) => slope.points.find(([at]) => at === t)?.[1] ?? null))];
}

function Slope({ card }: { card: CardInfo }): JSX.Element {
  const { data, why } = usePoll<SlopesAnswer>('slopes', { name: card.name }, 2000);
  const slopes = (data.value?.slopes ?? []).filter((one) => one.points.length > 1);
  const names = slopes.map((one) => `${one.name} (${one.unit})`);
  return (
    <Panel title="Slope" class="slope">
      {slopes.length === 0 ? <Empty>{why.value || 'No slope has been loaded into the card (command S).'}</Empty> : (
        <>
          <Chart data={joined(slopes)} names={names} xName="s" label="Slope tables of the card" height={240} />
          <Legend names={names} />
        </>
      )}
    </Panel>
  );
}

export function Databoard({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 200);
  const shown = card.registers.filter((one) => ['STAT', 'EVENT', 'C4'].includes(one.name));
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        {shown.map((one) => <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />)}
        <Quantities card={card} />
      </Panel>
      <Panel title="Ports" class="ports"><Console card={card} bits={8} /></Panel>
      <Slope card={card} />
    </>
  );
}
