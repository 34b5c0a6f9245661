// Panel of the grating bus: the frame of each card, its age, and whether all agree.
import type { JSX } from 'preact';
import type { CardInfo } from '../link/rack';
import { Icon } from '../parts/icons';
import { fixed, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Carrier, type CarrierState } from './carrier';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface BusCard {
  name: string;
  role: string;
  stale: boolean;
  off: boolean;
  agrees: boolean;
  age_us: number;
  frames: number;
  broken: number;
  untrue: number;
  unlike: number;
  frame?: number;
  skew_ns?: number;
  positions?: number[];
  addresses?: number[];
}
interface Bus {
  name: string;
  published: number;
  agree: boolean;
  reason: string;
  cards: BusCard[];
}
interface FramesAnswer {
  buses: Bus[];
  stages: CarrierState[];
}

const MAX_SCALES = 8;

const wordFor = (card: BusCard): string => (card.off ? 'off' : card.stale ? 'stale' : card.agrees ? 'yes' : 'no');

function Table({ bus }: { bus: Bus }): JSX.Element {
  const scales = Math.min(MAX_SCALES, Math.max(0, ...bus.cards.map((card) => card.positions?.length ?? 0)));
  return (
    <>
      <p class={`agreement ${bus.agree ? 'yes' : 'no'}`}>
        <Icon name={bus.agree ? 'check' : 'alarm'} />
        <strong>{bus.agree ? 'All cards hold the same frame' : bus.reason}</strong>
        <span class="tabular">{whole(bus.published)} frames published</span>
      </p>
      <div class="scroll" tabIndex={0} role="region" aria-label="Cards of the bus">
        <table class="counters frames-table">
          <thead>
            <tr>
              {['Card', 'Role', 'Frame', 'Age, us', 'Skew, ns', 'Broken', 'Untrue', 'Unlike'].map((head) => (
                <th key={head} scope="col">
                  {head}
                </th>
              ))}
              {Array.from({ length: scales }, (_, i) => (
                <th key={i} scope="col">
                  Scale {bus.cards[0]?.addresses?.[i] ?? i}
                </th>
              ))}
              <th scope="col">Agrees</th>
            </tr>
          </thead>
          <tbody>
            {bus.cards.map((card) => (
              <tr key={card.name}>
                <th scope="row">{card.name}</th>
                <td>{card.role}</td>
                <td class="tabular">{whole(card.frame)}</td>
                <td class="tabular">{fixed(card.age_us, 1)}</td>
                <td class="tabular">{fixed(card.skew_ns, 1)}</td>
                <td class="tabular">{whole(card.broken)}</td>
                <td class="tabular">{whole(card.untrue)}</td>
                <td class="tabular">{whole(card.unlike)}</td>
                {Array.from({ length: scales }, (_, i) => (
                  <td key={i} class="tabular">
                    {whole(card.positions?.[i])}
                  </td>
                ))}
                <td class={wordFor(card) === 'yes' ? '' : 'bad'}>{wordFor(card)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </>
  );
}

export function Frames(): JSX.Element {
  const { data, why } = usePoll<FramesAnswer>('frames', {}, 200);
  return (
    <Panel title="Frames of all cards" class="wide frames">
      {data.value === null ? (
        <Empty>{why.value || 'Asking for the frames …'}</Empty>
      ) : (
        <>
          {data.value.buses.map((bus) => (
            <Table key={bus.name} bus={bus} />
          ))}
          {data.value.stages.length > 0 && (
            <dl class="facts-list">
              {data.value.stages.map((stage) => (
                <Carrier key={stage.name} part={stage} />
              ))}
            </dl>
          )}
        </>
      )}
    </Panel>
  );
}

export function Grating({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 250);
  const shown = card.registers.filter((one) => ['ROLE', 'STATUS', 'STATE'].includes(one.name));
  return (
    <>
      <Frames />
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        {shown.map((one) => (
          <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />
        ))}
        <Quantities card={card} />
      </Panel>
    </>
  );
}
