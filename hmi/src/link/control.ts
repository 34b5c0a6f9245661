// The control lease: taken and given by hand, kept while this tab lives; nothing on the page takes it by itself.
import { ask } from './socket';
import { order } from './orders';
import { inControl, link } from './state';

const KEEP_MS = 3000;

export const takeControl = (force = false): void => void order('take_control', force ? { force } : {});
export const releaseControl = (): void => void order('release_control');

export function keepControl(): void {
  setInterval(() => {
    if (inControl.value && link.value === 'open') ask({ order: 'keep_control' }).catch(() => undefined);
  }, KEEP_MS);
}
