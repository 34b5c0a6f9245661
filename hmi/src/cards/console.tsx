// Manual bus accesses to a card: reads and writes ports and registers with all side effects.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { whyNot, commandFor, notice } from '../link/commands';
import { inControl, standsStill } from '../link/state';
import type { CardInfo } from '../link/rack';
import { hex } from '../parts/numbers';
import { Button, Empty, Field, Select } from '../parts/ui';
import { typedWord } from './words';

interface Line {
  text: string;
  answer: string;
}

export const mayAccess = (card: CardInfo): string =>
  whyNot('maintain', true) ||
  (!inControl.value ? 'Take control first.' : '') ||
  (standsStill.value || card.bus.while_moving ? '' : 'The bus is used by hand only while the machine stands still.');

/** A read register and a write register may share an offset. */
const namesAt = (card: CardInfo, offset: number): string =>
  card.registers
    .filter((one) => one.offset === offset)
    .map((one) => one.name)
    .join('/');

function Log({ lines }: { lines: readonly Line[] }): JSX.Element {
  return (
    <div class="log" role="log" aria-label="Accesses" tabIndex={0}>
      {lines.length === 0 && <Empty>Every access goes through the card's bus and has its effects.</Empty>}
      {lines.map((line, i) => (
        <p key={i}>
          <code>{line.text}</code>
          <span class="tabular">{line.answer}</span>
        </p>
      ))}
    </div>
  );
}

export function Console({ card }: { card: CardInfo }): JSX.Element {
  const bits = card.bus.widths[0] ?? 8;
  const log = useSignal<Line[]>([]);
  const place = useSignal('');
  const value = useSignal('0');
  const places = card.registers.filter((one, i, all) => all.findIndex((other) => other.offset === one.offset) === i);
  const chosen = place.value === '' ? (places[0]?.offset ?? 0) : Number(place.value);
  const add = (text: string, answer: string): void => void (log.value = [...log.value, { text, answer }].slice(-40));
  const write = async (address: number, what: number, name: string): Promise<void> => {
    if ((await commandFor('write_register', { card: card.name, bits, address, value: what })) !== null)
      add(name, hex(what, bits));
  };
  const read = async (): Promise<void> => {
    const reply = await commandFor('read_register', { card: card.name, bits, address: card.bus.base + chosen });
    if (reply !== null) add(`read ${namesAt(card, chosen)}`, hex(reply.value as number, bits));
  };
  const why = mayAccess(card);
  const send = (): void => {
    const what = typedWord(value.value, bits);
    if (what === null)
      notice(
        'refused',
        `"${value.value}" is not a number of ${bits} bits. Write 255, 0xFF, FFh or 'G'. Nothing was written.`,
      );
    else void write(card.bus.base + chosen, what, `write ${namesAt(card, chosen)}`);
  };
  return (
    <div class="console">
      <Log lines={log.value} />
      <div class="row">
        <Select
          label="Where"
          value={String(chosen)}
          onChange={(to) => (place.value = to)}
          options={places.map((one) => ({
            value: String(one.offset),
            text: `${hex(one.offset, 8)} ${namesAt(card, one.offset)}`,
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
    </div>
  );
}
