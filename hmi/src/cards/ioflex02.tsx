// The IOFLEX02's panel: positions of its four axes, calibration commands, what is wrong with an encoder.
import type { JSX } from 'preact';
import type { CardInfo } from '../link/rack';
import { fixed, whole } from '../parts/numbers';
import { orderFor } from '../link/orders';
import { usePoll } from '../parts/poll';
import { Button, Panel } from '../parts/ui';
import { Console, mayAccess } from './console';
import { Flags, Quantities, valueOf, wordOf, type CardAnswer } from './peek';

const AXES = [0, 1, 2, 3];
const ROWS = [
  { name: 'POS', text: 'position, counts' },
  { name: 'CAPTURED', text: 'captured position' },
  { name: 'INDEX', text: 'position at the index' },
  { name: 'ILLEGAL', text: 'illegal transitions' },
];
const COMMANDS = [
  { code: 1, name: 'cRes', text: 'Zero now' },
  { code: 2, name: 'cResNm', text: 'Zero at the index' },
  { code: 3, name: 'cResNmSig', text: 'Zero at index and signal' },
];

/** Values that exist, by the axis' number at the end of their names or as its channel. */
function find(answer: CardAnswer | null, name: string, axis: number): number | null {
  for (const full of [`${name}${axis}`, `${axis}.${name}`, `a${axis}.${name}`, `${name}_${axis}`]) {
    const value = valueOf(answer, full);
    if (value !== null) return value;
  }
  return null;
}

export function Flex({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 100);
  const command = card.registers.find((one) => one.name === 'CMD');
  const why = mayAccess();
  const rows = ROWS.filter((row) => AXES.some((axis) => find(data.value, row.name, axis) !== null));
  const send = (axis: number, code: number): void => {
    if (command !== undefined) void orderFor('write_register', { card: card.name, bits: 16, address: command.offset, value: code << (2 * axis) });
  };
  const shown = card.registers.filter((one) => ['STATUS', 'CFG_ERROR'].includes(one.name));
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        <table class="counters">
          <thead><tr><th scope="col">Axis</th>{rows.map((row) => <th key={row.name} scope="col">{row.text}</th>)}<th scope="col">Calibrate</th></tr></thead>
          <tbody>
            {AXES.map((axis) => (
              <tr key={axis}>
                <th scope="row">{axis}</th>
                {rows.map((row) => <td key={row.name} class="tabular">{whole(find(data.value, row.name, axis))}</td>)}
                <td><span class="buttons">{COMMANDS.map((one) => <Button key={one.name} why={why} label={`${one.text}, axis ${axis} (${one.name})`} onClick={() => send(axis, one.code)}>{one.name}</Button>)}</span></td>
              </tr>
            ))}
          </tbody>
        </table>
        {shown.map((one) => <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />)}
      </Panel>
      <Panel title="Diagnostics"><Quantities card={card} /><p class="hint tabular">{fixed((data.value?.registers ?? []).length, 0)} registers are looked at ten times a second.</p></Panel>
      <Panel title="Registers by hand" class="ports"><Console card={card} bits={16} /></Panel>
    </>
  );
}
