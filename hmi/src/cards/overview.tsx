// Overview of all cards, and the panel of one of them.
import type { ComponentType, JSX } from 'preact';
import { cardNamed, rack, type CardInfo } from '../link/rack';
import { Icon } from '../parts/icons';
import { Empty, Panel } from '../parts/ui';
import { address, detail } from '../view';
import { Databoard } from './databoard4002';
import { Flex } from './ioflex02';
import { Frames, Grating } from './grating_bus';
import { Functions } from './library';
import { Mcx } from './mcx314';
import { Pins } from './pins';
import { Laser } from './rtc5';

const PANELS: Record<string, ComponentType<{ card: CardInfo }>> = {
  mcx314: Mcx,
  databoard4002: Databoard,
  ioflex02: Flex,
  grating_bus: Grating,
  grating_decoder: Grating,
  rtc5: Laser,
};

function Tile({ card }: { card: CardInfo }): JSX.Element {
  return (
    <a class="tile" href={address('cards', card.name)}>
      <span class="slot">{card.slot < 0 ? '' : `slot ${card.slot}`}</span>
      <strong>{card.name}</strong>
      <span class="type">{card.type}</span>
      <span class="title">{card.title}</span>
      {card.live !== null && <span class="live">real card at {card.live}</span>}
      <span class="axes-of">
        {card.axes.length > 0
          ? `moves ${card.axes.map((axis) => axis.letter).join(', ')}`
          : card.live !== null
            ? 'moves in service only'
            : `${card.registers.length} registers, ${card.commands.length} commands, ${card.pins.length} pins`}
      </span>
    </a>
  );
}

export function Cards(): JSX.Element {
  const cards = rack.value?.cards ?? [];
  const card = cardNamed(detail.value);
  if (card === undefined)
    return (
      <div class="column">
        <Panel title={`Cards of ${rack.value?.name ?? 'the rack'}`}>
          {cards.length === 0 ? (
            <Empty>The rack has no cards.</Empty>
          ) : (
            <div class="tiles">
              {cards.map((one) => (
                <Tile key={one.name} card={one} />
              ))}
            </div>
          )}
        </Panel>
        {cards.some((one) => one.type === 'grating_bus') && <Frames />}
      </div>
    );
  const Own = PANELS[card.type];
  return (
    <>
      <nav class="pills" aria-label="Cards">
        <a href={address('cards')}>
          <Icon name="left" size={14} />
          all
        </a>
        {cards.map((one) => (
          <a key={one.name} href={address('cards', one.name)} aria-current={one === card ? 'page' : undefined}>
            {one.name}
            <small>{one.type}</small>
          </a>
        ))}
        <a class="far" href={address('registers', card.name)}>
          registers
        </a>
      </nav>
      <div class="cardview" key={card.name}>
        {Own !== undefined && <Own card={card} />}
        {card.functions > 0 && <Functions card={card} />}
        {card.live === null && <Pins card={card} />}
      </div>
    </>
  );
}
