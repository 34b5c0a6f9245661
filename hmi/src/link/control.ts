// Control lease: taken and released manually, kept while this tab is open; the page never takes it by itself.
import { ask } from './socket';
import { command, whyNot } from './commands';
import { holder, inControl, link, mayBeTakenOver, user } from './state';

const KEEP_MS = 3000;

/** Returns true if the user of this page holds control, possibly in another tab or browser. */
const own = (): boolean => holder.value !== '' && holder.value === user.value;

/** Reason why control may not be taken now; empty: allowed. During motion only the holder's other tabs may take it. */
export function whyNotControl(): string {
  const no = whyNot('operate');
  if (no !== '' || holder.value === '' || inControl.value || own() || mayBeTakenOver.value) return no;
  return `${holder.value} holds control and the machine moves. It can be taken over at standstill or in a hold.`;
}

/** Takes control by force, except from the same user during motion, which passes it on unchanged. */
export function takeControl(): void {
  const force = holder.value !== '' && !(own() && !mayBeTakenOver.value);
  void command('take_control', force ? { force } : {});
}
export const releaseControl = (): void => void command('release_control');

export function keepControl(): void {
  setInterval(() => {
    if (inControl.value && link.value === 'open') ask({ command: 'renew_control' }).catch(() => undefined);
  }, KEEP_MS);
}
