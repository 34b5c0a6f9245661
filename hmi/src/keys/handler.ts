// Key handling for the whole page. Runs before any element, so that Space never clicks a focused button.
import { armed, begin, end, slowDown } from '../jog/lease';
import { mayOperate, notice } from '../link/commands';
import { jogOf, KEYS, type Key } from './table';

/** Returns true for an input field that uses typed or selecting keys. */
function types(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement)
    return true;
  return target instanceof HTMLInputElement && !['button', 'submit', 'checkbox', 'radio', 'file'].includes(target.type);
}

function find(event: KeyboardEvent): Key | undefined {
  const written = event.getModifierState('AltGraph');
  if ((event.altKey && !written) || event.metaKey) return undefined;
  return KEYS.find((one) => one.keys.includes(event.key) && (one.ctrl ?? false) === (event.ctrlKey && !written));
}

function consume(event: KeyboardEvent): void {
  event.preventDefault();
  event.stopImmediatePropagation();
}

function pressJog(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey || !armed.peek()) return false;
  const jog = jogOf(event.key);
  if (jog === null) return false;
  consume(event);
  if (event.repeat) return true;
  const why = mayOperate();
  if (why === '') begin(`key ${event.code}`, jog.axis, jog.direction, event.shiftKey);
  else notice('refused', `Jog: ${why}`);
  return true;
}

function down(event: KeyboardEvent): void {
  if (event.isComposing) return;
  const typing = types(event.target);
  if (!typing && pressJog(event)) return;
  const key = find(event);
  if (key === undefined || (typing && !key.always)) return;
  consume(event);
  if (!event.repeat) key.press(event.key);
}

function up(event: KeyboardEvent): void {
  end(`key ${event.code}`);
  if (event.key === 'Shift') slowDown();
  // A button clicks when Space is released.
  if (event.key === ' ' && !types(event.target)) consume(event);
}

export function listen(): void {
  window.addEventListener('keydown', down, { capture: true });
  window.addEventListener('keyup', up, { capture: true });
}
