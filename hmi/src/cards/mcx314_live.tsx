// Panel of a real MCX314: the counters of its channels and its main status.
import type { JSX } from 'preact';
import type { CardInfo } from '../link/rack';
import { whole } from '../parts/numbers';
import { COUNTERS, CounterHeads } from './counters';
import { LiveCard } from './live_card';
import { Flags, valueOf, wordOf, type CardAnswer } from './peek';

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
  const main = card.registers.find((one) => one.name === 'RR0');
  return (
    <LiveCard card={card} place={place}>
      {(seen) => (
        <>
          <Counters card={card} seen={seen} />
          {main !== undefined && <Flags register={main} word={wordOf(seen, 'RR0')} />}
        </>
      )}
    </LiveCard>
  );
}
