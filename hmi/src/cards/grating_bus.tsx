// The grating bus' panel: which frame each card holds, how old it is, and whether all agree.
import type { JSX } from 'preact';
import type { CardInfo } from '../link/rack';
import { Icon } from '../parts/icons';
import { fixed, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface BusCard {
  name: string;
  role?: string;
  frame?: number | null;
  age_us?: number | null;
  skew_ns?: number | null;
  positions?: (number | null)[];
  agrees?: boolean;
}
interface FramesAnswer {
  buses?: { name: string; frame?: number | null; cards: BusCard[]; agree?: boolean; why?: string }[];
}

function Bus({ bus }: { bus: NonNullable<FramesAnswer['buses']>[number] }): JSX.Element {
  const scales = Math.max(0, ...bus.cards.map((card) => card.positions?.length ?? 0));
  return (
    <section class="bus" aria-label={`Bus ${bus.name}`}>
      <p class={`agreement ${bus.agree === false ? 'no' : 'yes'}`}>
        <Icon name={bus.agree === false ? 'alarm' : 'check'} />
        <strong>{bus.name}</strong>
        <span class="tabular">frame {whole(bus.frame)}</span>
        <span>{bus.agree === false ? `the cards do not agree${bus.why ? `: ${bus.why}` : ''}` : 'all cards hold the same positions'}</span>
      </p>
      <div class="scroll" tabIndex={0} role="region" aria-label={`Cards of bus ${bus.name}`}>
        <table class="counters">
          <thead>
            <tr><th scope="col">Card</th><th scope="col">Role</th><th scope="col">Frame</th><th scope="col">Age, us</th><th scope="col">Skew, ns</th>{Array.from({ length: scales }, (_, i) => <th key={i} scope="col">Scale {i}</th>)}<th scope="col">Agrees</th></tr>
          </thead>
          <tbody>
            {bus.cards.map((card) => (
              <tr key={card.name}>
                <th scope="row">{card.name}</th>
                <td>{card.role ?? '–'}</td>
                <td class="tabular">{whole(card.frame)}</td>
                <td class="tabular">{fixed(card.age_us, 1)}</td>
                <td class="tabular">{fixed(card.skew_ns, 1)}</td>
                {Array.from({ length: scales }, (_, i) => <td key={i} class="tabular">{whole(card.positions?.[i])}</td>)}
                <td>{card.agrees === undefined ? '–' : card.agrees ? 'yes' : <strong class="bad">no</strong>}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

export function Frames(): JSX.Element {
  const { data, why } = usePoll<FramesAnswer>('frames', {}, 200);
  const buses = data.value?.buses ?? [];
  return (
    <Panel title="Frames of all cards" class="wide frames">
      {buses.length === 0 ? <Empty>{why.value || 'The rack has no grating bus.'}</Empty> : buses.map((bus) => <Bus key={bus.name} bus={bus} />)}
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
        {shown.map((one) => <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />)}
        <Quantities card={card} />
      </Panel>
    </>
  );
}
