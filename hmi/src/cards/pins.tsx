// A card's pins as lamps, live.
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { channelNames, rack, type CardInfo } from '../link/rack';
import { fixed } from '../parts/numbers';
import { Empty, Led, Panel } from '../parts/ui';

const MOST = 48;

export function Pins({ card }: { card: CardInfo }): JSX.Element {
  const volts = new Set((rack.value?.wires ?? []).filter((wire) => wire.volts).map((wire) => wire.name));
  const pins = (card.pins ?? []).map((pin) => ({ ...pin, full: `${card.name}.${pin.name}` })).filter((pin) => channelNames.value.has(pin.full)).slice(0, MOST);
  const names = pins.map((pin) => pin.full).join(' ');
  useEffect(() => want(names === '' ? [] : names.split(' '), 10), [names]);
  return (
    <Panel title="Inputs and outputs" class="pins">
      {pins.length === 0 ? <Empty>The card has no pins that can be looked at.</Empty> : (
        <ul>
          {pins.map((pin) => {
            const level = channel(pin.full).value;
            return (
              <li key={pin.name} title={pin.meaning}>
                {volts.has(pin.full) ? <span class="volts tabular">{fixed(level, 3)} V</span> : <Led on={level === 1} letter={level === null ? '–' : String(level)} text={`${pin.name}, ${pin.meaning}`} />}
                <code>{pin.name}</code>
                <small>{pin.direction ?? ''}</small>
              </li>
            );
          })}
        </ul>
      )}
    </Panel>
  );
}
