// Basic components shared by all panels.
import type { ComponentChildren, JSX } from 'preact';
import { useId } from 'preact/hooks';
import { perform, type Action } from '../actions';
import { notice } from '../link/commands';
import { Icon, type IconName } from './icons';

interface ButtonProps {
  children: ComponentChildren;
  onClick(): void;
  /** Reason why it cannot be pressed now; empty: it can. It stays in the focus order and shows the reason. */
  why?: string;
  kind?: 'plain' | 'main' | 'quiet' | 'stop';
  icon?: IconName;
  machine?: boolean;
  pressed?: boolean;
  label?: string;
  class?: string;
}

export function Button(props: ButtonProps): JSX.Element {
  const why = props.why ?? '';
  const classes = ['button', props.kind ?? 'plain', props.machine ? 'machine' : '', props.class ?? ''].join(' ');
  return (
    <button
      type="button"
      class={classes}
      aria-disabled={why !== '' ? 'true' : undefined}
      aria-pressed={props.pressed}
      aria-label={props.label}
      title={why !== '' ? why : props.label}
      onClick={() => (why === '' ? props.onClick() : notice('refused', why))}>
      {props.icon && <Icon name={props.icon} />}
      {props.children !== '' && <span>{props.children}</span>}
    </button>
  );
}

export function ActionButton({
  action,
  children,
  ...more
}: { action: Action; children?: ComponentChildren } & Partial<ButtonProps>): JSX.Element {
  return (
    <Button machine why={action.why()} {...more} onClick={() => perform(action)}>
      {children ?? action.label}
    </Button>
  );
}

/** Switch, toggled by click or Enter; Space is feed hold everywhere. */
export function Switch(props: { on: boolean; label: string; onChange(on: boolean): void; why?: string }): JSX.Element {
  const why = props.why ?? '';
  return (
    <button
      type="button"
      class="switch"
      role="switch"
      aria-checked={props.on}
      aria-disabled={why !== '' ? 'true' : undefined}
      title={why || undefined}
      onClick={() => (why === '' ? props.onChange(!props.on) : notice('refused', why))}>
      <span class="track">
        <span class="thumb" />
      </span>
      <span>{props.label}</span>
      <span class="word">{props.on ? 'on' : 'off'}</span>
    </button>
  );
}

/** Selects one of several options. */
export function Choice<T extends string | number>(props: {
  label: string;
  options: readonly { value: T; text: string; why?: string }[];
  value: T;
  onChange(value: T): void;
  machine?: boolean;
}): JSX.Element {
  return (
    <div class="choice" role="group" aria-label={props.label}>
      {props.options.map((one) => (
        <Button
          key={one.value}
          machine={props.machine ?? false}
          pressed={one.value === props.value}
          why={one.why ?? ''}
          onClick={() => props.onChange(one.value)}>
          {one.text}
        </Button>
      ))}
    </div>
  );
}

export function Panel(props: {
  title: string;
  children: ComponentChildren;
  tools?: ComponentChildren;
  class?: string;
  note?: string;
}): JSX.Element {
  const id = useId();
  return (
    <section class={`panel ${props.class ?? ''}`} aria-labelledby={id}>
      <header>
        <h2 id={id}>{props.title}</h2>
        {props.tools && <div class="tools">{props.tools}</div>}
      </header>
      <div class="body">{props.children}</div>
      {props.note && <p class="note">{props.note}</p>}
    </section>
  );
}

export type LedKind = 'info' | 'warn' | 'alarm';

/** Lamp: on is filled, off is an outline; letter and shape show its meaning and severity. */
export function Led({
  on,
  letter,
  text,
  kind = 'info',
}: {
  on: boolean;
  letter: string;
  text: string;
  kind?: LedKind;
}): JSX.Element {
  return (
    <span
      class={`led ${kind} ${on ? 'on' : 'off'}`}
      role="img"
      aria-label={`${text}: ${on ? 'on' : 'off'}`}
      title={`${text}: ${on ? 'on' : 'off'}`}>
      {letter}
    </span>
  );
}

export function Field(props: {
  label: string;
  value: string;
  onInput(value: string): void;
  unit?: string;
  onEnter?(): void;
  wide?: boolean;
  placeholder?: string;
  mode?: 'decimal' | 'text';
}): JSX.Element {
  const id = useId();
  return (
    <div class={`field ${props.wide ? 'wide' : ''}`}>
      <label for={id}>{props.label}</label>
      <span class="entry">
        <input
          id={id}
          type="text"
          value={props.value}
          inputMode={props.mode ?? 'text'}
          autocomplete="off"
          spellcheck={false}
          placeholder={props.placeholder}
          onInput={(event) => props.onInput(event.currentTarget.value)}
          onKeyDown={(event) => event.key === 'Enter' && props.onEnter?.()}
        />
        {props.unit && <span class="unit">{props.unit}</span>}
      </span>
    </div>
  );
}

export function Select(props: {
  label: string;
  value: string;
  options: readonly { value: string; text: string }[];
  onChange(value: string): void;
}): JSX.Element {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{props.label}</label>
      <select id={id} value={props.value} onChange={(event) => props.onChange(event.currentTarget.value)}>
        {props.options.map((one) => (
          <option key={one.value} value={one.value}>
            {one.text}
          </option>
        ))}
      </select>
    </div>
  );
}

export function Empty({ children }: { children: ComponentChildren }): JSX.Element {
  return <p class="empty">{children}</p>;
}
