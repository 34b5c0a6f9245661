// Alarms with their ISA-18.2 states, and all events.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { acknowledge, perform } from '../actions';
import { alarmState } from '../link/alarms';
import type { Alarm } from '../link/contract';
import { whyNot } from '../link/commands';
import * as state from '../link/state';
import { Icon } from '../parts/icons';
import { seconds } from '../parts/numbers';
import { Button, Choice, Empty, Panel } from '../parts/ui';
import { narrow } from '../view';

function Row({ alarm }: { alarm: Alarm }): JSX.Element {
  const { word, tone } = alarmState(alarm);
  const action = acknowledge(alarm.number);
  return (
    <li class={`alarm ${tone}`}>
      <Icon name={tone === 'calm' ? 'check' : 'alarm'} size={20} />
      <div>
        <p class="text">{alarm.text}</p>
        <p class="about">
          <span class="tabular">{seconds(alarm.at)}</span>
          <span>{alarm.source || 'machine'}</span>
          <span>{word}</span>
        </p>
      </div>
      {!alarm.acknowledged && !narrow.value && (
        <Button why={action.why()} icon="check" onClick={() => perform(action)}>
          Acknowledge
        </Button>
      )}
    </li>
  );
}

export function Alarms(): JSX.Element {
  const alarms = [...(state.status.value?.alarms ?? [])].reverse();
  const unseen = alarms.filter((one) => !one.acknowledged);
  const all = (): void => unseen.forEach((one) => perform(acknowledge(one.number)));
  return (
    <Panel
      title="Alarms"
      class="alarms"
      tools={
        unseen.length > 1 && !narrow.value ? (
          <Button why={whyNot('operate')} onClick={all}>
            Acknowledge all
          </Button>
        ) : undefined
      }>
      {alarms.length === 0 ? (
        <Empty>No alarms since the program started.</Empty>
      ) : (
        <ul>
          {alarms.map((alarm) => (
            <Row key={alarm.number} alarm={alarm} />
          ))}
        </ul>
      )}
    </Panel>
  );
}

const KINDS = ['all', 'alarm', 'state', 'job', 'command', 'stop', 'setting'] as const;
const kind = signal<(typeof KINDS)[number]>('all');

export function Events(): JSX.Element {
  const shown = [...state.events.value].reverse().filter((one) => kind.value === 'all' || one.kind === kind.value);
  return (
    <Panel
      title="Events"
      class="events"
      tools={
        <Choice
          label="Kind of event"
          value={kind.value}
          onChange={(to) => (kind.value = to)}
          options={KINDS.map((one) => ({ value: one, text: one }))}
        />
      }>
      {shown.length === 0 ? (
        <Empty>Nothing has happened yet.</Empty>
      ) : (
        <div class="scroll" tabIndex={0} role="region" aria-label="List of events">
          <table>
            <thead>
              <tr>
                <th scope="col">No.</th>
                <th scope="col">Time</th>
                <th scope="col">Kind</th>
                <th scope="col">What</th>
              </tr>
            </thead>
            <tbody>
              {shown.slice(0, 200).map((one) => (
                <tr key={one.number} class={`kind-${one.kind}`}>
                  <td class="tabular">{one.number}</td>
                  <td class="tabular">{seconds(one.at)}</td>
                  <td>{one.kind}</td>
                  <td>{one.text}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </Panel>
  );
}
