// Second row: views, holder of control, clock, user of this browser, appearance.
import type { JSX } from 'preact';
import { releaseControl, takeControl, whyNotControl } from '../link/control';
import { dialogOpen, forget, inviteOpen } from '../link/pairing';
import { hasRole } from '../link/commands';
import * as state from '../link/state';
import { Icon, type IconName } from '../parts/icons';
import { Button } from '../parts/ui';
import { address, dark, helpOpen, largeNumbers, setTheme, view, type View } from '../view';

const TABS: readonly { view: View; text: string; icon: IconName }[] = [
  { view: 'operate', text: 'Operate', icon: 'jogging' },
  { view: 'scope', text: 'Scope', icon: 'moving' },
  { view: 'cards', text: 'Cards', icon: 'open' },
  { view: 'registers', text: 'Registers', icon: 'keys' },
  { view: 'faults', text: 'Faults', icon: 'power' },
  { view: 'events', text: 'Events', icon: 'alarm' },
];

function Control(): JSX.Element {
  const holder = state.holder.value;
  const mine = state.inControl.value;
  const why = whyNotControl();
  return (
    <div class="control" role="group" aria-label="Control">
      <span class={`holder ${mine ? 'mine' : ''}`}>
        <Icon name="hand" size={16} />
        {mine ? 'You hold control' : holder !== '' ? `${holder} holds control` : 'No user holds control'}
      </span>
      {mine ? (
        <Button kind="quiet" onClick={releaseControl}>
          Release
        </Button>
      ) : (
        <Button kind={why === '' && holder === '' ? 'main' : 'plain'} why={why} onClick={takeControl}>
          {holder === '' ? 'Take control' : 'Take over'}
        </Button>
      )}
    </div>
  );
}

function User(): JSX.Element {
  const role = state.role.value;
  const name = state.user.value;
  return (
    <div class="user" role="group" aria-label="This browser">
      <span class="who">
        <Icon name="user" size={16} />
        {name !== '' ? `${name}, ${role}` : role}
      </span>
      {hasRole('maintain') && (
        <Button kind="quiet" onClick={() => (inviteOpen.value = true)}>
          Invite
        </Button>
      )}
      {name === '' ? (
        <Button kind="quiet" onClick={() => (dialogOpen.value = true)}>
          Pair
        </Button>
      ) : (
        <Button kind="quiet" onClick={() => void forget()} label="Forget this browser's pairing">
          Forget
        </Button>
      )}
    </div>
  );
}

export function ToolBar(): JSX.Element {
  return (
    <div class="toolbar">
      <nav aria-label="Views">
        {TABS.map((tab) => (
          <a key={tab.view} href={address(tab.view)} aria-current={view.value === tab.view ? 'page' : undefined}>
            {tab.text}
          </a>
        ))}
      </nav>
      <div class="right">
        <Control />
        <User />
        <div class="looks">
          <Button
            kind="quiet"
            icon="large"
            pressed={largeNumbers.value}
            label="Large numbers"
            onClick={() => (largeNumbers.value = !largeNumbers.value)}>
            {''}
          </Button>
          <Button
            kind="quiet"
            icon={dark.value ? 'sun' : 'moon'}
            label={dark.value ? 'Light colours' : 'Dark colours'}
            onClick={() => setTheme(dark.value ? 'light' : 'dark')}>
            {''}
          </Button>
          <Button kind="quiet" icon="keys" label="Help (?)" onClick={() => (helpOpen.value = true)}>
            {''}
          </Button>
        </div>
      </div>
    </div>
  );
}
