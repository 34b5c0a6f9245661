// The DataBoard 4002's panel: its ports by hand, status and events, the slope as a picture.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import type { CardInfo } from '../link/rack';
import { fixed } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Chart, Legend } from '../scope/chart';
import { Console } from './console';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface Interval {
  position: number;
  rate: number;
  hz: number;
}
interface SlopesAnswer {
  deceleration: Interval[];
  acceleration: Interval[];
  moving: boolean;
  hz: number;
}

const NAMES = ['acceleration', 'deceleration'];

/** Speed over the way, both halves over one list of places. An interval's speed holds until its position. */
function curves(answer: SlopesAnswer): (number | null)[][] {
  const places = [...new Set([0, ...answer.acceleration, ...answer.deceleration].map((one) => (typeof one === 'number' ? one : one.position)))].sort((a, b) => a - b);
  const at = (half: Interval[], place: number): number | null => half.find((one) => place < one.position)?.hz ?? half[half.length - 1]?.hz ?? null;
  return [places, places.map((place) => at(answer.acceleration, place)), places.map((place) => at(answer.deceleration, place))];
}

function Slope({ card }: { card: CardInfo }): JSX.Element {
  const { data, why } = usePoll<SlopesAnswer>('slopes', { name: card.name }, 2000);
  const picture = useMemo(() => (data.value === null ? [[], [], []] : curves(data.value)), [JSON.stringify([data.value?.acceleration, data.value?.deceleration])]);
  const loaded = (picture[0]?.length ?? 0) > 2;
  return (
    <Panel title="Slope" class="slope">
      {!loaded ? <Empty>{why.value || 'No slope has been loaded into the card (command S).'}</Empty> : (
        <>
          <Chart data={picture} names={NAMES} xName="counts" label="Slope table: speed in Hz over the way in counts" height={240} stepped={() => true} />
          <Legend names={NAMES} />
          <p class="hint tabular">Hz over counts; {data.value?.moving === true ? `it moves at ${fixed(data.value.hz, 0)} Hz` : 'it stands'}</p>
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
      <Panel title="Ports" class="ports"><Console card={card} /></Panel>
      <Slope card={card} />
    </>
  );
}
