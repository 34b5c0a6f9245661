// Current view, and the settings of this browser: theme, large numbers.
import { effect, signal } from '@preact/signals';

export const VIEWS = ['operate', 'scope', 'cards', 'registers', 'faults', 'events'] as const;
export type View = (typeof VIEWS)[number];

export const view = signal<View>('operate');
/** Detail of the view: the card name. */
export const detail = signal('');
export const helpOpen = signal(false);

/** Decodes text from the address, which may be malformed. */
export function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

function read(): void {
  const [name = '', ...rest] = decoded(location.hash.replace(/^#\/?/, '')).split('/');
  view.value = (VIEWS as readonly string[]).includes(name) ? (name as View) : 'operate';
  detail.value = rest.join('/');
}

export const address = (to: View, what = ''): string => `#/${to}${what === '' ? '' : `/${encodeURIComponent(what)}`}`;

function keptFlag(key: string): ReturnType<typeof signal<boolean>> {
  const one = signal(localStorage.getItem(key) === 'yes');
  effect(() => localStorage.setItem(key, one.value ? 'yes' : 'no'));
  return one;
}

export const largeNumbers = keptFlag('motionrack.large');

export type Theme = 'system' | 'dark' | 'light';
export const theme = signal<Theme>((localStorage.getItem('motionrack.theme') as Theme | null) ?? 'system');
const systemDark = matchMedia('(prefers-color-scheme: dark)');
/** Displayed theme, from the setting or the system. */
export const dark = signal(true);

function paint(): void {
  dark.value = theme.value === 'system' ? systemDark.matches : theme.value === 'dark';
  document.documentElement.dataset.theme = dark.value ? 'dark' : 'light';
}

export function setTheme(to: Theme): void {
  theme.value = to;
  localStorage.setItem('motionrack.theme', to);
}

/** A phone shows the machine state and STOP only, without motion controls. */
const phone = matchMedia('(max-width: 599px)');
export const narrow = signal(phone.matches);

export function watch(): void {
  effect(paint);
  systemDark.addEventListener('change', paint);
  phone.addEventListener('change', () => (narrow.value = phone.matches));
  window.addEventListener('hashchange', read);
  read();
}
