// Which view is open, and what this browser is set to: theme, large numbers.
import { effect, signal } from '@preact/signals';

export const VIEWS = ['operate', 'scope', 'cards', 'registers', 'faults', 'events'] as const;
export type View = (typeof VIEWS)[number];

export const view = signal<View>('operate');
/** What of the view: the card's name. */
export const detail = signal('');
export const helpOpen = signal(false);

/** What somebody typed into the address need not be well formed. */
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
/** What is shown, whoever decided it. */
export const dark = signal(true);

function paint(): void {
  dark.value = theme.value === 'system' ? systemDark.matches : theme.value === 'dark';
  document.documentElement.dataset.theme = dark.value ? 'dark' : 'light';
}

export function setTheme(to: Theme): void {
  theme.value = to;
  localStorage.setItem('motionrack.theme', to);
}

/** A phone shows what the machine does, and STOP; nothing that moves it. */
const phone = matchMedia('(max-width: 599px)');
export const narrow = signal(phone.matches);

export function watch(): void {
  effect(paint);
  systemDark.addEventListener('change', paint);
  phone.addEventListener('change', () => (narrow.value = phone.matches));
  window.addEventListener('hashchange', read);
  read();
}
