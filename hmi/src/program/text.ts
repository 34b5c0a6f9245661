// Program in the panel: its name and text, kept over a reload.
import { computed, effect, signal } from '@preact/signals';
import { query } from '../link/commands';
import { link, status } from '../link/state';

const KEY = 'motionrack.program';
const MAX_KEPT = 2_000_000;

export const programName = signal(localStorage.getItem(`${KEY}.name`) ?? 'program.ngc');
export const program = signal(localStorage.getItem(KEY) ?? '');

/** The running program, started by any client. */
export const running = signal<{ name: string; text: string } | null>(null);
const runs = computed(() =>
  link.value === 'open' && status.value?.program.runs === true ? status.value.program.name : '',
);
effect(() => {
  if (runs.value === '') running.value = null;
  else
    query<{ name: string; text: string }>('program').then(
      (answer) => (running.value = answer),
      () => undefined,
    );
});

effect(() => {
  const text = program.value;
  try {
    localStorage.setItem(`${KEY}.name`, programName.value);
    if (text.length <= MAX_KEPT) localStorage.setItem(KEY, text);
    else localStorage.removeItem(KEY);
  } catch {
    // Browser storage is full or disabled: the text is kept only while the page is open.
  }
});
