// The control lease: taken and given by hand, kept while this tab lives; nothing on the page takes it by itself.
import { ask } from './socket';
import { order, whyNot } from './commands';
import { holder, inControl, link, mayBeTakenOver, user } from './state';

const KEEP_MS = 3000;

/** Held by another tab or browser of the same user. */
const own = (): boolean => holder.value !== '' && holder.value === user.value;

/** Why control may not be taken now; empty: it may. While the machine moves only its holder's other tab takes it. */
export function whyNotControl(): string {
  const no = whyNot('operate');
  if (no !== '' || holder.value === '' || inControl.value || own() || mayBeTakenOver.value) return no;
  return `${holder.value} holds control and the machine moves. It can be taken over at standstill or in a hold.`;
}

/** From its holder by force, but not from oneself while the machine moves: that passes it on as it is. */
export function takeControl(): void {
  const force = holder.value !== '' && !(own() && !mayBeTakenOver.value);
  void order('take_control', force ? { force } : {});
}
export const releaseControl = (): void => void order('release_control');

export function keepControl(): void {
  setInterval(() => {
    if (inControl.value && link.value === 'open') ask({ order: 'keep_control' }).catch(() => undefined);
  }, KEEP_MS);
}
