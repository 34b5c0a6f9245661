// Accesses to a card through its bus, by hand: ports and registers written and read with all their effects.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { whyNot, orderFor, notice } from '../link/orders';
import { inControl, standsStill } from '../link/state';
import type { CardInfo } from '../link/rack';
import { hex } from '../parts/numbers';
import { Button, Empty, Field, Select } from '../parts/ui';

interface Line {
  text: string;
  answer: string;
}

/** "1Fh", "0x1F", "31", "'G'" -> a number. */
export function number(text: string): number | null {
  const plain = text.trim();
  const letter = /^'(.)'$/.exec(plain);
  if (letter !== null) return (letter[1] ?? '').charCodeAt(0);
  if (/^[0-9a-f]+h$/i.test(plain)) return parseInt(plain, 16);
  if (/^(0x[0-9a-f]+|\d+)$/i.test(plain)) return Number(plain);
  return null;
}

export const mayAccess = (): string =>
  whyNot('maintain', true) ||
  (!inControl.value ? 'Take control first.' : '') ||
  (standsStill.value ? '' : 'The bus is used by hand only while the machine stands still.');

export function Console({ card }: { card: CardInfo }): JSX.Element {
  const bits = card.bus.widths[0] ?? 8;
  const log = useSignal<Line[]>([]);
  const place = useSignal('');
  const value = useSignal('0');
  const places = card.registers.filter((one, i, all) => all.findIndex((other) => other.offset === one.offset) === i);
  const chosen = place.value === '' ? String(places[0]?.offset ?? 0) : place.value;
  const placeName = (offset: string): string =>
    card.registers
      .filter((one) => one.offset === Number(offset))
      .map((one) => one.name)
      .join('/');
  const add = (text: string, answer: string): void => void (log.value = [...log.value, { text, answer }].slice(-40));
  const write = async (address: number, what: number, name: string): Promise<void> => {
    if ((await orderFor('write_register', { card: card.name, bits, address, value: what })) !== null)
      add(name, hex(what, bits));
  };
  const read = async (): Promise<void> => {
    const reply = await orderFor('read_register', { card: card.name, bits, address: card.bus.base + Number(chosen) });
    if (reply !== null) add(`read ${placeName(chosen)}`, hex(reply.value as number, bits));
  };
  const why = mayAccess();
  const send = (): void => {
    const what = number(value.value);
    if (what === null || what < 0 || what >= 2 ** bits)
      notice(
        'refused',
        `"${value.value}" is no number of ${bits} bits; 255, 0xFF, FFh or 'G' are. Nothing was written.`,
      );
    else void write(card.bus.base + Number(chosen), what, `write ${placeName(chosen)}`);
  };
  const commandPort = card.registers.find((one) => one.name === 'C2');
  return (
    <div class="console">
      <div class="log" role="log" aria-label="Accesses" tabIndex={0}>
        {log.value.length === 0 && <Empty>Every access goes through the card's bus and has its effects.</Empty>}
        {log.value.map((line, i) => (
          <p key={i}>
            <code>{line.text}</code>
            <span class="tabular">{line.answer}</span>
          </p>
        ))}
      </div>
      <div class="row">
        <Select
          label="Where"
          value={chosen}
          onChange={(to) => (place.value = to)}
          options={places.map((one) => ({
            value: String(one.offset),
            text: `${hex(one.offset, 8)} ${placeName(String(one.offset))}`,
          }))}
        />
        <Field label="Value" value={value.value} onInput={(text) => (value.value = text)} />
        <Button why={why} onClick={send}>
          Write
        </Button>
        <Button why={why} onClick={() => void read()}>
          Read
        </Button>
      </div>
      {commandPort !== undefined && (
        <div class="commands" role="group" aria-label="Commands">
          {card.commands.map((command) => (
            <Button
              key={command.name}
              why={why}
              label={`${command.name}: ${command.meaning}`}
              onClick={() => void write(card.bus.base + commandPort.offset, command.code, `command ${command.name}`)}>
              {command.name}
            </Button>
          ))}
        </div>
      )}
    </div>
  );
}
