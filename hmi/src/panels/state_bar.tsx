// Always visible: STOP and its neighbours, the machine state, SIMULATION, the emergency stop input, alarms.
import type { JSX } from 'preact';
import { acknowledge, actions, perform } from '../actions';
import type { StateName } from '../link/contract';
import { rack } from '../link/rack';
import * as state from '../link/state';
import { Icon, type IconName } from '../parts/icons';
import { ActionButton, Button } from '../parts/ui';
import { address, narrow } from '../view';

interface Look {
  icon: IconName;
  word: string;
  tone: 'calm' | 'moves' | 'attention' | 'alarm';
}

const LOOKS = {
  disabled: { icon: 'disabled', word: 'Disabled', tone: 'calm' },
  standstill: { icon: 'standstill', word: 'Standstill', tone: 'calm' },
  homing: { icon: 'home', word: 'Homing', tone: 'moves' },
  moving: { icon: 'moving', word: 'Moving', tone: 'moves' },
  jogging: { icon: 'jogging', word: 'Jogging', tone: 'moves' },
  hold: { icon: 'hold', word: 'Hold', tone: 'attention' },
  stopping: { icon: 'stopping', word: 'Stopping', tone: 'attention' },
  'error stop': { icon: 'alarm', word: 'Error stop', tone: 'alarm' },
  service: { icon: 'hand', word: 'Service', tone: 'attention' },
} satisfies Record<StateName, Look>;
/** A program newer than the page may have states that the page does not know. */
const lookOf = (name: string): Look =>
  (LOOKS as Partial<Record<string, Look>>)[name] ?? { icon: 'alarm', word: name, tone: 'attention' };

function Stop(): JSX.Element {
  return (
    <button
      type="button"
      class="stop"
      onClick={() => perform(actions.stop)}
      title="STOP: controlled stop, the program is aborted (Esc). This is not an emergency stop.">
      <Icon name="stop" size={26} />
      <span>STOP</span>
    </button>
  );
}

function StateChip(): JSX.Element {
  const look = lookOf(state.machineState.value);
  const why = state.status.value?.reason ?? '';
  return (
    <div class={`state ${look.tone}`} role="status" aria-live="polite">
      <Icon name={look.icon} size={22} />
      <span class="word">{look.word}</span>
      {why !== '' && (
        <span class="why" title={why}>
          {why}
        </span>
      )}
    </div>
  );
}

function Estop(): JSX.Element | null {
  const input = state.status.value?.estop;
  if (input === undefined) return null;
  const word = !input.wired ? 'not wired' : input.pressed ? 'PRESSED' : 'released';
  const tone = input.wired && input.pressed ? 'alarm' : 'calm';
  return (
    <div class={`fact ${tone}`}>
      <span class="name">E-stop input</span>
      <span class="value">
        <Icon name={tone === 'alarm' ? 'alarm' : input.wired ? 'check' : 'disabled'} size={15} />
        {word}
      </span>
    </div>
  );
}

function Alarms(): JSX.Element {
  const count = state.openAlarms.value.filter((one) => one.active).length;
  const unseen = state.openAlarms.value.filter((one) => !one.acknowledged).length;
  return (
    <a class={`fact ${count > 0 ? 'alarm' : unseen > 0 ? 'attention' : 'calm'}`} href={address('events')}>
      <span class="name">Alarms</span>
      <span class="value">
        <Icon name={count + unseen > 0 ? 'alarm' : 'check'} size={15} />
        {count === 0 ? 'none active' : `${count} active`}
        {unseen > 0 && `, ${unseen} new`}
      </span>
    </a>
  );
}

function LinkAge(): JSX.Element {
  const { value: link } = state.link;
  const text = link === 'connecting' ? 'connecting' : link === 'lost' ? 'lost' : state.stale.value ? 'silent' : 'live';
  return (
    <div
      class={`fact ${text === 'live' ? 'calm' : 'attention'}`}
      title={`Status messages skipped because this browser was slow: ${state.lost.value}`}>
      <span class="name">Data</span>
      <span class="value tabular">
        <Icon name={text === 'live' ? 'link' : 'lost'} size={15} />
        {text} {state.ageText(state.age.value)}
      </span>
    </div>
  );
}

/** Shows that motion is simulated, except while a real card is in service. */
export function Simulation(): JSX.Element | null {
  const real = (rack.value?.cards ?? []).filter((card) => card.live !== null).map((card) => card.name);
  const { value: now } = state.status;
  if (now?.simulation === false)
    return (
      <span class="simulation real" title={`Card ${now.service ?? ''} is a real one: its motors move.`}>
        REAL CARD {now.service}
      </span>
    );
  if (!(state.hello.value?.simulation ?? true)) return null;
  const but = real.length === 0 ? '; nothing real moves' : `, but for ${real.join(', ')}, which moves in service only`;
  return (
    <span class="simulation" title={`Cards, motors and machine are simulated${but}.`}>
      SIMULATION
    </span>
  );
}

export function StateBar(): JSX.Element {
  return (
    <div class="statebar">
      <Stop />
      {!narrow.value && (
        <div class="flow" role="group" aria-label="Motion">
          <ActionButton action={actions.hold} icon="hold" />
          <ActionButton action={actions.resume} icon="resume" />
          <ActionButton action={actions.reset} icon="reset" />
        </div>
      )}
      <StateChip />
      <Simulation />
      <div class="facts">
        <Estop />
        <Alarms />
        <LinkAge />
      </div>
    </div>
  );
}

/** Unacknowledged alarms, below the bar in every view. */
export function AlarmBanner(): JSX.Element {
  const unseen = state.openAlarms.value.filter((one) => !one.acknowledged);
  const newest = unseen[unseen.length - 1];
  return (
    <div class="alarmlive" aria-live="assertive" role="alert">
      {newest !== undefined && (
        <div class="banner">
          <Icon name="alarm" size={20} />
          <p>
            <strong>Alarm</strong> {newest.text}
          </p>
          {unseen.length > 1 && <a href={address('events')}>and {unseen.length - 1} more</a>}
          {!narrow.value && <Acknowledge number={newest.number} />}
        </div>
      )}
    </div>
  );
}

function Acknowledge({ number }: { number: number }): JSX.Element {
  const action = acknowledge(number);
  return (
    <Button why={action.why()} icon="check" onClick={() => perform(action)}>
      Acknowledge
    </Button>
  );
}
