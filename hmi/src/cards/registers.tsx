// Registers of a card with bit names, read by peek without side effects.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { cardNamed, rack, type CardInfo, type RegisterInfo } from '../link/rack';
import { Icon } from '../parts/icons';
import { fixed, hex, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Field, Panel } from '../parts/ui';
import { address, detail } from '../view';
import type { CardAnswer } from './peek';
import { fieldValues } from './words';

function Bits({ register, word }: { register: RegisterInfo; word: number }): JSX.Element {
  return (
    <ul class="bits">
      {fieldValues(register, word).map(({ field, bits, value }) => (
        <li key={field.name} class={value !== 0 ? 'set' : ''} title={field.meaning}>
          <span class="place tabular">{bits}</span>
          <code>{field.name}</code>
          <span class="value tabular">{field.bits === 1 ? value : hex(value, field.bits)}</span>
        </li>
      ))}
    </ul>
  );
}

function Row({
  name,
  register,
  word,
  open,
  onOpen,
}: {
  name: string;
  register: RegisterInfo | undefined;
  word: number | null;
  open: boolean;
  onOpen: () => void;
}): JSX.Element {
  const has = (register?.fields.length ?? 0) > 0;
  const setBits =
    register === undefined || word === null
      ? ''
      : fieldValues(register, word)
          .filter((one) => one.value !== 0)
          .map((one) => one.field.name)
          .join(' ');
  return (
    <li class={`register ${open ? 'open' : ''}`}>
      <button type="button" aria-expanded={has ? open : undefined} onClick={onOpen}>
        <code class="name">{name}</code>
        <span class="word tabular">{hex(word, register?.width ?? 16)}</span>
        <span class="meaning">{register?.meaning ?? ''}</span>
        <span class="setbits">{setBits}</span>
        {has && <Icon name={open ? 'up' : 'down'} size={14} />}
      </button>
      {open && has && register !== undefined && word !== null && <Bits register={register} word={word} />}
    </li>
  );
}

export function Inspector({ card }: { card: CardInfo }): JSX.Element {
  const filter = useSignal('');
  const opened = useSignal<readonly string[]>([]);
  const { data, why } = usePoll<CardAnswer>('card', { name: card.name }, 250);
  const fits = (name: string): boolean => name.toLowerCase().includes(filter.value.toLowerCase());
  const registers = (data.value?.registers ?? []).filter((one) => fits(one.name));
  const own = new Set((data.value?.registers ?? []).map((one) => one.name));
  const values = (data.value?.values ?? []).filter(({ name }) => fits(name) && !own.has(name));
  const numbers = (data.value?.quantities ?? []).filter(({ name }) => fits(name));
  const toggle = (name: string): void => {
    opened.value = opened.value.includes(name) ? opened.value.filter((one) => one !== name) : [...opened.value, name];
  };
  return (
    <>
      <Field label="Find" value={filter.value} wide placeholder="RR0, LP …" onInput={(text) => (filter.value = text)} />
      {why.value !== '' && <p class="why">{why.value}</p>}
      {data.value?.reason !== undefined && <p class="why">{data.value.reason}</p>}
      {data.value !== null &&
        data.value.reason === undefined &&
        registers.length + values.length + numbers.length === 0 && (
          <Empty>{filter.value === '' ? 'This card shows no registers.' : 'No register of that name.'}</Empty>
        )}
      <ul class="registers">
        {registers.map((one) => (
          <Row
            key={one.name}
            name={one.name}
            word={one.word}
            register={card.registers.find((info) => info.name === one.register)}
            open={opened.value.includes(one.name)}
            onOpen={() => toggle(one.name)}
          />
        ))}
      </ul>
      {values.length + numbers.length > 0 && (
        <dl class="values">
          {values.map(({ name, value }) => (
            <div key={name}>
              <dt>
                <code>{name}</code>
              </dt>
              <dd class="tabular">{whole(value)}</dd>
            </div>
          ))}
          {numbers.map(({ name, value }) => (
            <div key={name}>
              <dt>
                <code>{name}</code>
              </dt>
              <dd class="tabular">{fixed(value, 3)}</dd>
            </div>
          ))}
        </dl>
      )}
    </>
  );
}

export function Registers(): JSX.Element {
  const cards = rack.value?.cards ?? [];
  const card = cardNamed(detail.value) ?? cards[0];
  if (card === undefined)
    return (
      <Panel title="Registers">
        <Empty>The rack has no cards.</Empty>
      </Panel>
    );
  return (
    <>
      <nav class="pills" aria-label="Cards">
        {cards.map((one) => (
          <a key={one.name} href={address('registers', one.name)} aria-current={one === card ? 'page' : undefined}>
            {one.name}
            <small>{one.type}</small>
          </a>
        ))}
      </nav>
      <Panel
        title={`Registers of ${card.name}`}
        class="inspector"
        note={
          card.live === null
            ? 'Read without side effects: not through the bus, so nothing is cleared.'
            : `A real card at ${card.live}: its service reads it through the port; registers that reading clears are left out.`
        }>
        <Inspector key={card.name} card={card} />
      </Panel>
    </>
  );
}
