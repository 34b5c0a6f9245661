// Pins of a card as live lamps.
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { channelNames, type CardInfo } from '../link/rack';
import { fixed, whole } from '../parts/numbers';
import { Empty, Led, Panel } from '../parts/ui';

const MOST = 48;

export function Pins({ card }: { card: CardInfo }): JSX.Element {
  const pins = card.pins
    .map((pin) => ({ ...pin, full: `${card.name}.${pin.name}` }))
    .filter((pin) => channelNames.value.has(pin.full))
    .slice(0, MOST);
  const names = pins.map((pin) => pin.full).join(' ');
  useEffect(() => want(names === '' ? [] : names.split(' '), 10), [names]);
  return (
    <Panel title="Inputs and outputs" class="pins">
      {pins.length === 0 ? (
        <Empty>The card has no pins that can be looked at.</Empty>
      ) : (
        <ul>
          {pins.map((pin) => {
            const level = channel(pin.full).value;
            return (
              <li key={pin.name} title={pin.meaning}>
                {pin.volts ? (
                  <span class="volts tabular">{fixed(level, 3)} V</span>
                ) : pin.bits > 1 ? (
                  <span class="volts tabular">{whole(level)}</span>
                ) : (
                  <Led
                    on={level === 1}
                    letter={level === null ? '–' : String(level)}
                    text={`${pin.name}, ${pin.meaning}`}
                  />
                )}
                <code>{pin.name}</code>
                <small>{pin.direction === 'input' ? 'in' : 'out'}</small>
              </li>
            );
          })}
        </ul>
      )}
    </Panel>
  );
}
