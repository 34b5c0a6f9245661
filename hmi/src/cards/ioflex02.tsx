// The IOFLEX02's panel: positions of its four axes, calibration commands, what is wrong with an encoder.
import type { JSX } from 'preact';
import { orderFor } from '../link/orders';
import type { CardInfo } from '../link/rack';
import { whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Button, Led, Panel } from '../parts/ui';
import { Console, mayAccess } from './console';
import { Flags, Quantities, valueOf, wordOf, type CardAnswer } from './peek';

const AXES = [0, 1, 2, 3];
const COMMANDS = [
  { code: 1, name: 'cRes', text: 'zero now' },
  { code: 2, name: 'cResNm', text: 'zero at the index' },
  { code: 3, name: 'cResNmSig', text: 'zero at index and signal' },
];

function Axis({ card, answer, axis }: { card: CardInfo; answer: CardAnswer | null; axis: number }): JSX.Element {
  const command = card.registers.find((one) => one.name === 'CMD');
  const why = mayAccess();
  const calibrated = valueOf(answer, `${axis}.CALIBRATED`);
  const illegal = valueOf(answer, `${axis}.ILLEGAL_TRANSITIONS`);
  const send = (code: number): void => {
    if (command !== undefined)
      void orderFor('write_register', {
        card: card.name,
        bits: 16,
        address: card.bus.base + command.offset,
        value: (code << (2 * axis)) | (0xf00 & ~(0x100 << axis)), // KEEP: the other axes take no command
      });
  };
  return (
    <tr>
      <th scope="row">{axis}</th>
      <td class="tabular">{whole(valueOf(answer, `${axis}.POSITION`))}</td>
      <td class="tabular">
        <Led on={calibrated === 1} letter="C" text={`Axis ${axis} calibrated`} />
      </td>
      <td class="tabular">
        <span class={illegal !== null && illegal > 0 ? 'bad' : ''}>{whole(illegal)}</span>
      </td>
      <td>
        <span class="buttons">
          {COMMANDS.map((one) => (
            <Button
              key={one.name}
              why={why}
              label={`${one.name}, axis ${axis}: ${one.text}`}
              onClick={() => send(one.code)}>
              {one.name}
            </Button>
          ))}
        </span>
      </td>
    </tr>
  );
}

export function Flex({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 100);
  const shown = card.registers.filter((one) => ['STATUS', 'CFG_ERROR'].includes(one.name));
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        <div class="scroll" tabIndex={0} role="region" aria-label="Axes of the card">
          <table class="counters">
            <thead>
              <tr>
                {['Axis', 'Position, counts', 'Calibrated', 'Illegal transitions', 'Calibrate'].map((head) => (
                  <th key={head} scope="col">
                    {head}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {AXES.map((axis) => (
                <Axis key={axis} card={card} answer={data.value} axis={axis} />
              ))}
            </tbody>
          </table>
        </div>
      </Panel>
      <Panel title="Diagnostics">
        {shown.map((one) => (
          <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />
        ))}
        {card.quantities.length > 0 && <Quantities card={card} />}
      </Panel>
      <Panel title="Registers by hand" class="ports">
        <Console card={card} />
      </Panel>
    </>
  );
}
