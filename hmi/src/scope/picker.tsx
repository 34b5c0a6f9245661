// Channel selection: type part of a name, then select a match.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { channelList } from '../link/rack';
import { notice } from '../link/commands';
import { Icon } from '../parts/icons';
import { Field } from '../parts/ui';
import { matching } from './matching';

const SHOWN = 30;

export function Picker(props: {
  chosen: readonly string[];
  max: number;
  onChange(chosen: string[]): void;
}): JSX.Element {
  const filter = useSignal('');
  const fits = matching(channelList.value, props.chosen, filter.value);
  const add = (name: string): void => {
    if (props.chosen.length >= props.max) notice('refused', `At most ${props.max} channels. Remove one first.`);
    else props.onChange([...props.chosen, name]);
  };
  return (
    <div class="picker">
      <ul class="chosen" aria-label="Channels chosen">
        {props.chosen.map((name) => (
          <li key={name}>
            <code>{name}</code>
            <button
              type="button"
              class="button quiet"
              aria-label={`Take ${name} away`}
              onClick={() => props.onChange(props.chosen.filter((one) => one !== name))}>
              <Icon name="close" size={14} />
            </button>
          </li>
        ))}
      </ul>
      <Field
        label="Add a channel"
        value={filter.value}
        wide
        placeholder="X.error, CV, limit …"
        onInput={(text) => (filter.value = text)}
        onEnter={() => fits[0] !== undefined && add(fits[0].name)}
      />
      <ul class="found" aria-label="Channels found" tabIndex={0}>
        {fits.slice(0, SHOWN).map((one) => (
          <li key={one.name}>
            <button type="button" title={one.text} onClick={() => add(one.name)}>
              <code>{one.name}</code>
              <small>{one.unit}</small>
            </button>
          </li>
        ))}
        {fits.length > SHOWN && <li class="hint">{fits.length - SHOWN} more</li>}
      </ul>
    </div>
  );
}
