// The program that is in the panel: its name and text, kept over a reload.
import { effect, signal } from '@preact/signals';

const KEY = 'motionrack.program';
const MOST_KEPT = 2_000_000;

export const programName = signal(localStorage.getItem(`${KEY}.name`) ?? 'program.ngc');
export const program = signal(localStorage.getItem(KEY) ?? '');

effect(() => {
  const text = program.value;
  try {
    localStorage.setItem(`${KEY}.name`, programName.value);
    if (text.length <= MOST_KEPT) localStorage.setItem(KEY, text);
    else localStorage.removeItem(KEY);
  } catch {
    // The browser's store is full or closed: then the text lives as long as the page.
  }
});
