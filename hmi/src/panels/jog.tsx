// Jog pad: arrows that move while held, or one step per press.
import type { JSX } from 'preact';
import { armed, begin, end, jogging, setArmed, setSpeedPart, setStep, speedPart, stepIndex, STEPS } from '../jog/lease';
import { padOf } from '../keys/table';
import { mayOperate, notice } from '../link/commands';
import * as state from '../link/state';
import { Icon, type IconName } from '../parts/icons';
import { fixed, percent, unitName } from '../parts/numbers';
import { Choice, Panel, Switch } from '../parts/ui';

const SPEEDS = [0.01, 0.05, 0.2, 0.5, 1];

function Arrow(props: { axis: string; direction: 1 | -1; icon: IconName; place: string }): JSX.Element {
  const why = mayOperate();
  const sign = props.direction < 0 ? '−' : '+';
  const held = jogging.value.includes((props.direction < 0 ? '-' : '+') + props.axis);
  const who = (kind: string): string => `${kind} ${sign}${props.axis}`;
  const press = (kind: string): void =>
    why === '' ? begin(who(kind), props.axis, props.direction) : notice('refused', `Jog: ${why}`);
  const pointerDown = (event: PointerEvent): void => {
    if (event.button !== 0) return;
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    press('pointer');
  };
  return (
    <button
      type="button"
      class={`jog ${props.place} ${held ? 'held' : ''}`}
      aria-label={`Jog ${props.axis} ${sign}`}
      aria-disabled={why !== '' ? 'true' : undefined}
      title={why || undefined}
      onPointerDown={pointerDown}
      onPointerUp={() => end(who('pointer'))}
      onPointerCancel={() => end(who('pointer'))}
      onLostPointerCapture={() => end(who('pointer'))}
      onContextMenu={(event) => event.preventDefault()}
      onBlur={() => end(who('enter'))}
      onKeyDown={(event) => event.key === 'Enter' && !event.repeat && press('enter')}
      onKeyUp={(event) => event.key === 'Enter' && end(who('enter'))}>
      <Icon name={props.icon} size={20} />
      <span>
        {props.axis}
        {sign}
      </span>
    </button>
  );
}

function Pad(): JSX.Element {
  const { x, y, columns } = padOf([...state.axisLetters.value]);
  return (
    <div class="pad">
      <div class="cross">
        {y !== undefined && <Arrow axis={y} direction={1} icon="up" place="north" />}
        {x !== undefined && <Arrow axis={x} direction={-1} icon="left" place="west" />}
        {x !== undefined && <Arrow axis={x} direction={1} icon="right" place="east" />}
        {y !== undefined && <Arrow axis={y} direction={-1} icon="down" place="south" />}
      </div>
      {columns.map((one) => (
        <div class="column" key={one}>
          <Arrow axis={one} direction={1} icon="up" place="plus" />
          <Arrow axis={one} direction={-1} icon="down" place="minus" />
        </div>
      ))}
    </div>
  );
}

/** Jog speed of the first axis, as a hint; empty: the machine has no axis. */
function speedHint(): string {
  const first = state.axes.value[0];
  if (first === undefined) return '';
  const speed = first.max_velocity * speedPart.value;
  return `${fixed(speed, speed < 10 ? 2 : 0)} ${unitName(first.unit)}/s on ${first.letter}`;
}

export function Jog(): JSX.Element {
  const speed = speedHint();
  return (
    <Panel
      title="Jog"
      class="jogpanel"
      tools={<Switch on={armed.value} label="Keyboard" onChange={setArmed} why={armed.value ? '' : mayOperate()} />}>
      <Pad />
      <div class="line">
        <span class="name" title="i: next, c: continuous">
          Step
        </span>
        <Choice
          label="Jog step"
          value={stepIndex.value}
          onChange={setStep}
          options={STEPS.map((step, i) => ({ value: i, text: step === null ? 'hold' : String(step) }))}
        />
      </div>
      <div class="line">
        <span class="name">Speed</span>
        <Choice
          label="Jog speed"
          value={speedPart.value}
          onChange={setSpeedPart}
          options={SPEEDS.map((part) => ({ value: part, text: percent(part) }))}
        />
      </div>
      <p class="hint">
        {STEPS[stepIndex.value] === null ? `Moves while held, ${speed}.` : `One step a press, ${speed}.`}
      </p>
    </Panel>
  );
}
