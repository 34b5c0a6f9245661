// Axis positions: commanded, actual, following error, velocity; lamps; enable and home.
import type { JSX } from 'preact';
import { actions, axisLetter, chosenAxis, placeText } from '../actions';
import { LEDS, type AxisStatus, type LedName } from '../link/contract';
import { mayOperate, command } from '../link/commands';
import * as state from '../link/state';

import { Icon } from '../parts/icons';
import { fixed, position, unitName } from '../parts/numbers';
import { ActionButton, Button, Field, Led, Panel, type LedKind } from '../parts/ui';
import { largeNumbers, narrow } from '../view';
import { Homing } from './homing';

const LAMPS: Record<LedName, { letter: string; text: string; kind: LedKind }> = {
  soft_minus: { letter: 'S−', text: 'software limit −', kind: 'warn' },
  soft_plus: { letter: 'S+', text: 'software limit +', kind: 'warn' },
  hard_minus: { letter: 'L−', text: 'limit switch −', kind: 'alarm' },
  hard_plus: { letter: 'L+', text: 'limit switch +', kind: 'alarm' },
  home: { letter: 'H', text: 'home switch', kind: 'info' },
  cam: { letter: 'R', text: 'reference cam', kind: 'info' },
  index: { letter: 'I', text: 'encoder index', kind: 'info' },
  capture: { letter: 'C', text: 'capture input', kind: 'info' },
  compare: { letter: 'K', text: 'compare output', kind: 'info' },
  in_position: { letter: 'P', text: 'in position', kind: 'info' },
  alarm: { letter: 'F', text: 'drive fault', kind: 'alarm' },
};

/** Lamps of an axis. */
export function Lamps({ axis }: { axis: AxisStatus }): JSX.Element {
  return (
    <div class="lamps">
      {LEDS.filter((name) => axis.leds[name] !== undefined).map((name) => (
        <Led key={name} on={axis.leds[name] === true} {...LAMPS[name]} text={`${axis.letter} ${LAMPS[name].text}`} />
      ))}
    </div>
  );
}

/** Selects the axis for touch off. */
function Letter({ axis, chosen }: { axis: AxisStatus; chosen: boolean }): JSX.Element {
  if (narrow.value) return <span class="letter">{axis.letter}</span>;
  return (
    <button
      type="button"
      class="letter"
      aria-pressed={chosen}
      title={`Choose axis ${axis.letter} for touch off`}
      onClick={() => (chosenAxis.value = axis.letter)}>
      {axis.letter}
    </button>
  );
}

function Homed({ axis }: { axis: AxisStatus }): JSX.Element {
  const meaning = axis.position_valid
    ? 'The position is valid: homed or set'
    : 'The position is not valid: home the axis, or set its position';
  return (
    <span class={`homed ${axis.position_valid ? 'yes' : 'no'}`} title={meaning}>
      <Icon name={axis.position_valid ? 'check' : 'alarm'} size={14} />
      {axis.position_valid ? 'homed' : 'not homed'}
    </span>
  );
}

/** Enable and home of one axis. */
function Ways({ axis }: { axis: AxisStatus }): JSX.Element {
  const noHome = axis.can_home ? '' : `Axis ${axis.letter} has no home switch; set its position instead.`;
  return (
    <div class="ways">
      <Button
        machine
        icon="power"
        pressed={axis.enabled}
        why={mayOperate()}
        label={`Axis ${axis.letter} enabled`}
        onClick={() => void command('enable', { on: !axis.enabled, axes: axis.letter })}>
        {''}
      </Button>
      <Button
        machine
        icon="home"
        why={mayOperate() || noHome}
        label={`Home axis ${axis.letter}`}
        onClick={() => void command('home', { axes: axis.letter })}>
        {''}
      </Button>
    </div>
  );
}

function Axis({ axis }: { axis: AxisStatus }): JSX.Element {
  const unit = unitName(axis.unit);
  const chosen = chosenAxis.value === axis.letter;
  return (
    <div class={`axis ${chosen ? 'chosen' : ''}`} role="group" aria-label={`Axis ${axis.letter}`}>
      <Letter axis={axis} chosen={chosen} />
      <div class="main">
        <output class="commanded tabular" aria-label={`${axis.letter} commanded, ${axis.unit}`}>
          {position(axis.commanded, axis.unit)}
        </output>
        <span class="unit">{unit}</span>
      </div>
      <dl>
        <div>
          <dt>actual</dt>
          <dd class="tabular">{position(axis.actual, axis.unit)}</dd>
        </div>
        <div>
          <dt>error</dt>
          <dd class="tabular">{position(axis.error, axis.unit)}</dd>
        </div>
        <div>
          <dt>{unit}/s</dt>
          <dd class="tabular">{fixed(axis.velocity, 2)}</dd>
        </div>
      </dl>
      <Homed axis={axis} />
      <Lamps axis={axis} />
      {!narrow.value && <Ways axis={axis} />}
    </div>
  );
}

export function Dro(): JSX.Element {
  const disabled = state.machineState.value === 'disabled';
  return (
    <Panel title="Axes" class={`dro ${largeNumbers.value ? 'large' : ''}`} tools={<Age />}>
      <div class="axes">
        {state.axes.value.map((axis) => (
          <Axis key={axis.letter} axis={axis} />
        ))}
      </div>
      {!narrow.value && (
        <div class="row">
          <ActionButton action={actions.enable} icon="power" kind={disabled ? 'main' : 'plain'}>
            {disabled ? 'Enable drives' : 'Disable drives'}
          </ActionButton>
          <ActionButton action={actions.home} icon="home" />
        </div>
      )}
      {!narrow.value && (
        <div class="row">
          <Field
            label={`${axisLetter()} position`}
            value={placeText.value}
            mode="decimal"
            unit={unitName(state.axisOf(axisLetter())?.unit ?? '')}
            onInput={(text) => (placeText.value = text)}
          />
          <span title="In work coordinates (G10 L20)">
            <ActionButton action={actions.touchOff} icon="zero">
              Touch off {axisLetter()}
            </ActionButton>
          </span>
          <span title="In machine coordinates; the position is valid then">
            <ActionButton action={actions.declare} icon="check">
              Set {axisLetter()}
            </ActionButton>
          </span>
        </div>
      )}
      <Homing />
    </Panel>
  );
}

/** Age of the numbers, if they are too old to rely on. */
function Age(): JSX.Element | null {
  if (!state.stale.value || state.received.value === 0) return null;
  return <span class="age">these values are {(state.age.value / 1000).toFixed(1)} s old</span>;
}
