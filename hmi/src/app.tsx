// The whole page: bars, the current view, dialogs, notices.
import type { JSX } from 'preact';
import { Cards } from './cards/overview';
import { Registers } from './cards/registers';
import { Help } from './keys/help';
import { dismiss, notices } from './link/commands';
import * as state from './link/state';
import { Alarms, Events } from './panels/events';
import { Clock } from './panels/clock';
import { Dro } from './panels/dro';
import { Faults } from './panels/faults';
import { Jog } from './panels/jog';
import { Mdi } from './panels/mdi';
import { Overrides } from './panels/overrides';
import { Inviting, Pairing } from './panels/pairing';
import { Program, Progress } from './panels/program';
import { AlarmBanner, StateBar } from './panels/state_bar';
import { ToolBar } from './panels/tool_bar';
import { Path } from './path/panel';
import { Scope } from './scope/panel';
import { Icon } from './parts/icons';
import { Panel } from './parts/ui';
import { narrow, view } from './view';

/** A rack without axes: its cards in place of axes, path and program. */
function CardsAlone(): JSX.Element {
  return (
    <div class="view two">
      <div class="column">
        <Panel title="Machine">
          <p class="hint">This rack has no axes, so no program runs on it. Operate its cards on their pages.</p>
        </Panel>
        <Clock />
      </div>
      <Cards />
    </div>
  );
}

function Operate(): JSX.Element {
  if (state.axisLetters.value === '') return <CardsAlone />;
  return (
    <div class="view operate">
      <div class="column">
        <Dro />
        <Clock />
      </div>
      <div class="column middle">
        <Path />
        <Program />
      </div>
      <div class="column">
        <Jog />
        <Overrides />
        <Mdi />
      </div>
    </div>
  );
}

function View(): JSX.Element {
  switch (view.value) {
    case 'operate':
      return <Operate />;
    case 'scope':
      return (
        <div class="view">
          <Scope />
        </div>
      );
    case 'cards':
      return (
        <div class="view">
          <Cards />
        </div>
      );
    case 'registers':
      return (
        <div class="view">
          <Registers />
        </div>
      );
    case 'faults':
      return (
        <div class="view">
          <Faults />
        </div>
      );
    case 'events':
      return (
        <div class="view two">
          <Alarms />
          <Events />
        </div>
      );
  }
}

/** View of a phone (from 360 px): machine state and STOP. */
function Phone(): JSX.Element {
  return (
    <div class="view phone">
      {state.axisLetters.value !== '' && <Dro />}
      {state.status.value?.program.name ? (
        <Panel title="Program">
          <Progress />
        </Panel>
      ) : null}
      <Alarms />
      <p class="hint">This view shows the status and STOP. Use a wider screen to operate the machine.</p>
    </div>
  );
}

function Notices(): JSX.Element {
  return (
    <div class="notices" role="status" aria-live="polite">
      {notices.value.map((one) => (
        <div key={one.key} class={`notice ${one.kind}`}>
          <Icon name={one.kind === 'done' ? 'check' : 'alarm'} />
          <p>{one.text}</p>
          <button type="button" class="button quiet" aria-label="Close this message" onClick={() => dismiss(one.key)}>
            <Icon name="close" size={16} />
          </button>
        </div>
      ))}
    </div>
  );
}

export function App(): JSX.Element {
  return (
    <>
      <header class="bars">
        <StateBar />
        {!narrow.value && <ToolBar />}
        <AlarmBanner />
      </header>
      <main>
        <h1 class="hidden">{state.hello.value?.rack ?? 'Motionrack'}, operator panel</h1>
        {state.status.value === null ? (
          <p class="waiting">
            {state.link.value === 'lost'
              ? 'The connection to the program was lost; trying again …'
              : 'Connecting to the program …'}
          </p>
        ) : narrow.value ? (
          <Phone />
        ) : (
          <View />
        )}
      </main>
      <footer>
        <span>{state.hello.value?.rack ?? ''}</span>
        <span>Motionrack {state.hello.value?.version ?? ''}</span>
        <span>STOP on this page is not an emergency stop: a real machine needs one with its own wires.</span>
      </footer>
      <Notices />
      <Pairing />
      <Inviting />
      <Help />
    </>
  );
}
