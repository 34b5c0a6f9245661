// Panel of a real MCX314: its address and the values read by its service. Independent of the virtual card.
import type { JSX } from 'preact';
import { status } from '../link/state';
import type { CardInfo } from '../link/rack';
import { whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { COUNTERS, CounterHeads } from './counters';
import { Flags, valueOf, wordOf, type CardAnswer } from './peek';

const EVERY_MS = 250;

function Counters({ card, seen }: { card: CardInfo; seen: CardAnswer }): JSX.Element {
  return (
    <table class="counters live">
      <thead>
        <tr>
          <CounterHeads />
        </tr>
      </thead>
      <tbody>
        {card.channels.map((which) => (
          <tr key={which}>
            <th scope="row">{which}</th>
            {COUNTERS.map((one) => (
              <td key={one.name} class="tabular">
                {whole(valueOf(seen, `${which}.${one.name}`))}
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function LiveMcx({ card, place }: { card: CardInfo; place: string }): JSX.Element {
  const { data, why } = usePoll<CardAnswer>('card', { name: card.name }, EVERY_MS);
  const seen = data.value;
  const none = why.value !== '' ? why.value : (seen?.reason ?? '');
  const main = card.registers.find((one) => one.name === 'RR0');
  const moves = status.value?.service === card.name;
  return (
    <Panel
      title={`${card.name}: ${card.title}`}
      class="wide"
      note="Read through its port after each call and twice a second while it is in service."
      tools={
        <strong class={`livecard ${moves ? 'moves' : ''}`}>{moves ? 'REAL CARD, IN SERVICE' : 'REAL CARD'}</strong>
      }>
      <p>
        At <code>{place}</code>. Its motors are real: have an emergency stop of its wires. Its limit switches and inputs
        act in the card itself and stop nothing of the machine here.
      </p>
      {seen === null || none !== '' ? (
        <Empty>{none !== '' ? none : 'The card is being asked for.'}</Empty>
      ) : (
        <>
          <Counters card={card} seen={seen} />
          {main !== undefined && <Flags register={main} word={wordOf(seen, 'RR0')} />}
        </>
      )}
    </Panel>
  );
}
