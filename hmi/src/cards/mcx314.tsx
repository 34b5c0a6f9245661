// Panel of the MCX314: counters of its channels at the refresh rate of the source's panel, velocity charts, drive
// flags.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { channel, want } from '../link/channels';
import { channelNames, type CardInfo } from '../link/rack';
import { mayOperate, notice, command, whyInService } from '../link/commands';
import { axisOf } from '../link/state';
import { typed, unitName, whole } from '../parts/numbers';
import { Button, Choice, Field, Led, Panel } from '../parts/ui';
import { Lamps } from '../panels/dro';
import { Chart, Legend } from '../scope/chart';
import { COUNTERS, CounterHeads } from './counters';
import { useHistory } from './history';
import { LiveMcx } from './mcx314_live';
import { fieldValues } from './words';

const EVERY_HZ = 100;

const axisAt = (card: CardInfo, which: string): string | undefined =>
  card.axes.find((axis) => axis.channel === which)?.letter;

function Counters({ card }: { card: CardInfo }): JSX.Element {
  const names = card.channels
    .flatMap((which) => COUNTERS.map((one) => `${card.name}.${which}.${one.name}`))
    .filter((name) => channelNames.value.has(name));
  const key = names.join(' ');
  useEffect(() => want(key === '' ? [] : key.split(' '), EVERY_HZ), [key]);
  return (
    <table class="counters">
      <thead>
        <tr>
          <CounterHeads />
          <th scope="col">Lamps</th>
        </tr>
      </thead>
      <tbody>
        {card.channels.map((which) => {
          const letter = axisAt(card, which);
          const axis = letter === undefined ? undefined : axisOf(letter);
          return (
            <tr key={which}>
              <th scope="row">
                {which}
                <small>{letter === undefined ? 'no axis' : `axis ${letter}`}</small>
              </th>
              {COUNTERS.map((one) => (
                <td key={one.name} class="tabular">
                  {whole(channel(`${card.name}.${which}.${one.name}`).value)}
                </td>
              ))}
              <td>{axis !== undefined ? <Lamps axis={axis} /> : <span class="hint">–</span>}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Speeds({ card }: { card: CardInfo }): JSX.Element {
  const what = useSignal<'CV' | 'LP' | 'EP' | 'CA'>('CV');
  const names = card.channels
    .map((which) => `${card.name}.${which}.${what.value}`)
    .filter((name) => channelNames.value.has(name));
  const data = useHistory(names, EVERY_HZ, 10);
  return (
    <Panel
      title="Last ten seconds"
      class="trend"
      tools={
        <Choice
          label="What the picture shows"
          value={what.value}
          onChange={(to) => (what.value = to)}
          options={COUNTERS.map((one) => ({ value: one.name, text: one.name }))}
        />
      }>
      <Chart
        data={data.value}
        names={names}
        xName="s"
        label={`${what.value} of all channels, last ten seconds`}
        height={220}
      />
      <Legend names={names} />
    </Panel>
  );
}

/** Manual moves of one axis. */
function Moves({ card }: { card: CardInfo }): JSX.Element {
  const letters = card.channels.map((which) => axisAt(card, which)).filter((one): one is string => one !== undefined);
  const chosen = useSignal('');
  const distance = useSignal('10');
  const speed = useSignal('20');
  const letter = letters.includes(chosen.value) ? chosen.value : letters[0];
  const why = mayOperate() || whyInService() || (letter === undefined ? 'No axis is on this card.' : '');
  const unit = unitName(letter === undefined ? 'mm' : (axisOf(letter)?.unit ?? 'mm'));
  const move = (direction: 1 | -1): void => {
    const [by, at] = [typed(distance.value), typed(speed.value)];
    if (by === null || at === null) notice('refused', 'Distance and speed must be numbers. Nothing was moved.');
    else void command('jog_by', { axis: letter, distance: direction * by, speed: at });
  };
  return (
    <Panel title="Moves and homing" class="moves">
      <Choice
        label="Axis"
        value={letter ?? ''}
        onChange={(to) => (chosen.value = to)}
        options={letters.map((one) => ({ value: one, text: one }))}
      />
      <div class="row">
        <Field
          label="Distance"
          value={distance.value}
          unit={unit}
          mode="decimal"
          onInput={(text) => (distance.value = text)}
        />
        <Field
          label="Speed"
          value={speed.value}
          unit={`${unit}/s`}
          mode="decimal"
          onInput={(text) => (speed.value = text)}
        />
        <Button machine why={why} icon="left" onClick={() => move(-1)}>
          Move −
        </Button>
        <Button machine why={why} icon="right" onClick={() => move(1)}>
          Move +
        </Button>
      </div>
      <div class="row">
        <Button machine icon="home" why={why} onClick={() => void command('home', { axes: letter })}>
          Home {letter}
        </Button>
      </div>
      {whyInService() !== '' && <p class="hint">{whyInService()}</p>}
    </Panel>
  );
}

/** Drive flags of RR0. */
function Drives({ card }: { card: CardInfo }): JSX.Element | null {
  const name = `${card.name}.RR0`;
  const has = channelNames.value.has(name);
  useEffect(() => want(has ? [name] : [], 20), [has, name]);
  const register = card.registers.find((one) => one.name === 'RR0');
  const word = channel(name).value;
  if (!has || register === undefined) return null;
  return (
    <div class="flags" role="group" aria-label="RR0, main status">
      {fieldValues(register, word ?? 0)
        .filter(({ field }) => field.bits === 1)
        .reverse()
        .map(({ field, value }) => (
          <span key={field.name} class="flag" title={field.meaning}>
            <Led on={word !== null && value === 1} letter={word === null ? '–' : String(value)} text={field.meaning} />
            <code>{field.name}</code>
          </span>
        ))}
    </div>
  );
}

export function Mcx({ card }: { card: CardInfo }): JSX.Element {
  if (card.live !== null) return <LiveMcx card={card} place={card.live} />;
  return (
    <>
      <Panel title={`${card.name}: ${card.title}`} class="wide" note={`Read ${EVERY_HZ} times a second.`}>
        <Counters card={card} />
        <Drives card={card} />
      </Panel>
      <Speeds card={card} />
      <Moves card={card} />
    </>
  );
}
