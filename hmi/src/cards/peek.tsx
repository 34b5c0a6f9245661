// Selected registers of a card as lamps, and its numbers; shared by several card panels.
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { channelList, type CardInfo, type RegisterInfo } from '../link/rack';
import { fixed, hex, whole } from '../parts/numbers';
import { Empty, Led } from '../parts/ui';
import { fieldValues } from './words';

export interface CardAnswer {
  /** Simulated time, s. */
  at: number;
  registers: { name: string; register: string; word: number }[];
  values: { name: string; value: number }[];
  quantities: { name: string; value: number }[];
  pins: Record<string, number>;
  /** Reason why a real card has no values. */
  reason?: string;
}

export const wordOf = (answer: CardAnswer | null, name: string): number | null =>
  answer?.registers.find((one) => one.name === name)?.word ?? null;
export const valueOf = (answer: CardAnswer | null, name: string): number | null =>
  answer?.values.find((one) => one.name === name)?.value ?? wordOf(answer, name);

/** One register: single bits are lamps, wider fields numbers. */
export function Flags({ register, word }: { register: RegisterInfo; word: number | null }): JSX.Element {
  return (
    <div class="flagset" role="group" aria-label={`${register.name}, ${register.meaning}`}>
      <p class="head">
        <code>{register.name}</code>
        <span class="tabular">{hex(word, register.width)}</span>
        <small>{register.meaning}</small>
      </p>
      <div class="flags">
        {fieldValues(register, word ?? 0)
          .reverse()
          .map(({ field, value }) => (
            <span key={field.name} class="flag" title={field.meaning}>
              {field.bits === 1 ? (
                <Led
                  on={word !== null && value === 1}
                  letter={word === null ? '–' : String(value)}
                  text={field.meaning}
                />
              ) : (
                <span class="volts tabular">{word === null ? '–' : value}</span>
              )}
              <code>{field.name}</code>
            </span>
          ))}
      </div>
    </div>
  );
}

/** Live numbers published by the card. */
export function Quantities({ card }: { card: CardInfo }): JSX.Element {
  const own = channelList.value.filter(
    (one) => one.name.startsWith(`${card.name}.`) && card.quantities.includes(one.name.slice(card.name.length + 1)),
  );
  const key = own.map((one) => one.name).join(' ');
  useEffect(() => want(key === '' ? [] : key.split(' '), 10), [key]);
  if (own.length === 0) return <Empty>The card reports no values of its own.</Empty>;
  return (
    <dl class="values">
      {own.map((one) => (
        <div key={one.name} title={one.text}>
          <dt>
            <code>{one.name.slice(card.name.length + 1)}</code>
          </dt>
          <dd class="tabular">
            {one.unit === '' && Number.isInteger(channel(one.name).value)
              ? whole(channel(one.name).value)
              : fixed(channel(one.name).value, 3)}{' '}
            <small>{one.unit}</small>
          </dd>
        </div>
      ))}
    </dl>
  );
}
