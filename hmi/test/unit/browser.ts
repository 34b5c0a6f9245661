// Minimal fake browser for the page's modules: storage, events, clock, and sockets that a test answers.
import { vi } from 'vitest';

export interface Settings {
  /** Part of the address after #. */
  hash?: string;
  /** Initial content of localStorage. */
  stored?: Record<string, string>;
  secure?: boolean;
  prefersDark?: boolean;
  narrow?: boolean;
}

/** One WebSocket of the page, with access to its messages for the test. */
export class FakeSocket {
  static readonly OPEN = 1;
  static readonly CLOSED = 3;
  static all: FakeSocket[] = [];
  readyState = 0;
  onopen: (() => void) | null = null;
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: (() => void) | null = null;
  onsent: (text: string) => void = () => undefined;
  constructor(readonly url: string) {
    FakeSocket.all.push(this);
  }
  send(text: string): void {
    this.onsent(text);
  }
  close(): void {
    this.readyState = FakeSocket.CLOSED;
    this.onclose?.();
  }
}

/** The answer of matchMedia, changed by the test. */
class Media extends EventTarget {
  constructor(public matches: boolean) {
    super();
  }
  turn(to: boolean): void {
    this.matches = to;
    this.dispatchEvent(new Event('change'));
  }
}

/** An element that receives keys; `type`: as of an input element. */
export class FakeElement extends EventTarget {
  isContentEditable = false;
  type = 'text';
}
export class FakeInput extends FakeElement {}
export class FakeTextArea extends FakeElement {}
export class FakeSelect extends FakeElement {}

interface Post {
  path: string;
  body: unknown;
  authorization: string | undefined;
}

export class Browser {
  readonly window = new EventTarget();
  readonly document = Object.assign(new EventTarget(), {
    hidden: false,
    documentElement: { classList: { toggle: vi.fn() }, dataset: {} as Record<string, string> },
  });
  readonly location: Record<string, unknown> & { hash: string };
  readonly store: Map<string, string>;
  readonly systemDark: Media;
  readonly phone: Media;
  readonly posts: Post[] = [];
  /** Answer to HTTP requests; an Error: the request fails. */
  http: { ok: boolean; status: number; body: unknown } | Error = { ok: true, status: 200, body: {} };

  constructor(settings: Settings) {
    this.store = new Map(Object.entries(settings.stored ?? {}));
    this.systemDark = new Media(settings.prefersDark ?? true);
    this.phone = new Media(settings.narrow ?? false);
    this.location = {
      hash: settings.hash ?? '',
      protocol: settings.secure === true ? 'https:' : 'http:',
      host: 'rack.test:8080',
      pathname: '/panel/',
      search: '',
      reload: vi.fn(),
    };
  }

  fetch(path: string, request: { body?: string; headers?: Record<string, string> }): Promise<unknown> {
    const body: unknown = request.body === undefined ? undefined : JSON.parse(request.body);
    this.posts.push({ path, body, authorization: request.headers?.authorization });
    const answer = this.http;
    if (answer instanceof Error) return Promise.reject(answer);
    return Promise.resolve({ ...answer, json: () => Promise.resolve(answer.body) });
  }

  /** The newest connection that the page made. */
  get socket(): FakeSocket {
    const newest = FakeSocket.all.at(-1);
    if (newest === undefined) throw new Error('The page has made no connection.');
    return newest;
  }

  get connections(): number {
    return FakeSocket.all.length;
  }

  hide(hidden: boolean): void {
    this.document.hidden = hidden;
    this.document.dispatchEvent(new Event('visibilitychange'));
  }

  goTo(hash: string): void {
    this.location.hash = hash;
    this.window.dispatchEvent(new Event('hashchange'));
  }
}

function storeOf(browser: Browser): Partial<Storage> {
  return {
    getItem: (key) => browser.store.get(key) ?? null,
    setItem: (key, value) => void browser.store.set(key, value),
    removeItem: (key) => void browser.store.delete(key),
  };
}

/** Opens a new browser with a stopped clock; modules imported afterwards are loaded again. */
export function openBrowser(settings: Settings = {}): Browser {
  vi.resetModules();
  vi.useFakeTimers();
  // Simulates loading time: at time 0 the page would report that nothing was received yet.
  vi.advanceTimersByTime(1000);
  FakeSocket.all = [];
  const browser = new Browser(settings);
  const globals = {
    window: Object.assign(browser.window, { dispatchEvent: browser.window.dispatchEvent.bind(browser.window) }),
    document: browser.document,
    location: browser.location,
    navigator: { language: 'en' },
    devicePixelRatio: 1,
    history: { replaceState: () => (browser.location.hash = '') },
    localStorage: storeOf(browser),
    matchMedia: (query: string) => (query.includes('color-scheme') ? browser.systemDark : browser.phone),
    crypto: { getRandomValues: (array: Uint16Array) => array.fill(0x2f1e) },
    fetch: browser.fetch.bind(browser),
    CustomEvent: Event,
    WebSocket: FakeSocket,
    HTMLElement: FakeElement,
    HTMLInputElement: FakeInput,
    HTMLTextAreaElement: FakeTextArea,
    HTMLSelectElement: FakeSelect,
  };
  for (const [name, value] of Object.entries(globals)) vi.stubGlobal(name, value);
  return browser;
}

/** Waits until all pending promises are settled, without advancing the clock. */
export const settled = (): Promise<unknown> => vi.advanceTimersByTimeAsync(0);
export const after = (ms: number): Promise<unknown> => vi.advanceTimersByTimeAsync(ms);
