// Panel of the IOFLEX02: positions and velocities of its four axes, calibration commands, time, inputs and outputs,
// encoder faults.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import { commandFor } from '../link/commands';
import type { CardInfo } from '../link/rack';
import { fixed, whole } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Button, Led, Panel, Select } from '../parts/ui';
import { wordOfAll, wordOfOne } from './calibration';
import { Console, mayAccess } from './console';
import { Flags, Quantities, valueOf, wordOf, type CardAnswer } from './peek';

const AXES = [0, 1, 2, 3];
const HEADS = [
  'Axis',
  'Position, counts',
  'Velocity, counts/s',
  'Lines',
  'Calibrated',
  'Illegal transitions',
  'Calibrate',
];
const NO_COMMAND = { code: 0, name: 'cNop', text: 'no calibration' };
const COMMANDS = [
  { code: 1, name: 'cRes', text: 'zero now' },
  { code: 2, name: 'cResNm', text: 'zero at the index' },
  { code: 3, name: 'cResNmSig', text: 'zero at index and signal' },
];

/** Input lines of an axis. */
const LINES = [
  { name: 'a', text: 'track A' },
  { name: 'b', text: 'track B' },
  { name: 'z', text: 'index' },
  { name: 'cal', text: 'calibration signal' },
];
const TICK_S = 1.2e-6;

/** Current and previous answer. */
interface Seen {
  now: CardAnswer | null;
  before: CardAnswer | null;
}

/** Counts per second between two answers, from RAW, which calibration does not set to 0. */
export function velocityOf({ now, before }: Seen, axis: number): number | null {
  const [to, from] = [valueOf(now, `${axis}.RAW`), valueOf(before, `${axis}.RAW`)];
  if (now === null || before === null || to === null || from === null || now.at <= before.at) return null;
  return (to - from) / (now.at - before.at);
}

function write(card: CardInfo, register: string, value: number): void {
  const found = card.registers.find((one) => one.name === register);
  if (found === undefined) return;
  void commandFor('write_register', { card: card.name, bits: 16, address: card.bus.base + found.offset, value });
}

/** The four commands of WriteCmd. */
function AllAxes({ card }: { card: CardInfo }): JSX.Element {
  const codes = useSignal(AXES.map(() => NO_COMMAND.code));
  const options = [NO_COMMAND, ...COMMANDS].map((one) => ({
    value: String(one.code),
    text: `${one.name}: ${one.text}`,
  }));
  return (
    <div class="row" role="group" aria-label="Commands of all axes">
      {AXES.map((axis) => (
        <Select
          key={axis}
          label={`Cmd${axis}`}
          value={String(codes.value[axis])}
          options={options}
          onChange={(code) => (codes.value = codes.value.map((was, at) => (at === axis ? Number(code) : was)))}
        />
      ))}
      <Button
        why={mayAccess(card)}
        label="WriteCmd: give each axis its command, all at one instant"
        onClick={() => write(card, 'CMD', wordOfAll(codes.value))}>
        WriteCmd
      </Button>
    </div>
  );
}

function Axis({ card, seen, axis }: { card: CardInfo; seen: Seen; axis: number }): JSX.Element {
  const why = mayAccess(card);
  const answer = seen.now;
  const calibrated = valueOf(answer, `${axis}.CALIBRATED`);
  const illegal = valueOf(answer, `${axis}.ILLEGAL_TRANSITIONS`);
  const send = (code: number): void => write(card, 'CMD', wordOfOne(axis, code));
  return (
    <tr>
      <th scope="row">{axis}</th>
      <td class="tabular">{whole(valueOf(answer, `${axis}.POSITION`))}</td>
      <td class="tabular">{fixed(velocityOf(seen, axis), 0)}</td>
      <td class="levels">
        {LINES.map((line) => (
          <Led
            key={line.name}
            on={answer?.pins[`${line.name}${axis}`] === 1}
            letter={line.name.charAt(0).toUpperCase()}
            text={`Axis ${axis}, ${line.text}`}
          />
        ))}
      </td>
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

/** The 16 outputs of X5, one byte per register. */
function Outputs({ card, answer }: { card: CardInfo; answer: CardAnswer | null }): JSX.Element {
  const why = mayAccess(card);
  const level = (output: number): number => answer?.pins[`out${output}`] ?? 0;
  const turn = (output: number): void => {
    const first = output < 8 ? 0 : 8;
    let byte = 0;
    for (let bit = 0; bit < 8; ++bit) {
      const on = first + bit === output ? level(output) === 0 : level(first + bit) === 1;
      byte |= on ? 1 << bit : 0;
    }
    write(card, first === 0 ? 'OUTL' : 'OUTH', byte);
  };
  return (
    <div class="commands" role="group" aria-label="Outputs">
      {[...Array(16).keys()].map((output) => (
        <Button
          key={output}
          why={why}
          label={`Output ${output}, ${level(output) === 1 ? 'high' : 'low'}: invert it`}
          onClick={() => turn(output)}>
          {output} {level(output) === 1 ? '●' : '○'}
        </Button>
      ))}
    </div>
  );
}

export function Flex({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 100);
  const seen = useRef<Seen>({ now: null, before: null });
  if (data.value !== seen.current.now) seen.current = { now: data.value, before: seen.current.now };
  const ticks = valueOf(data.value, 'TIME');
  const shown = card.registers.filter((one) => ['STATUS', 'CFG_ERROR'].includes(one.name));
  return (
    <>
      <Panel
        title={`${card.name}: ${card.title}`}
        class="wide"
        note={`Time of the card: ${fixed(ticks === null ? null : ticks * TICK_S, 3)} s.`}>
        <div class="scroll" tabIndex={0} role="region" aria-label="Axes of the card">
          <table class="counters">
            <thead>
              <tr>
                {HEADS.map((head) => (
                  <th key={head} scope="col">
                    {head}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {AXES.map((axis) => (
                <Axis key={axis} card={card} seen={seen.current} axis={axis} />
              ))}
            </tbody>
          </table>
        </div>
        <AllAxes card={card} />
      </Panel>
      <Panel title="Outputs of X5">
        <Outputs card={card} answer={data.value} />
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
