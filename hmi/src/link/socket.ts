// WebSocket to the program: requests with answers, snapshots, events; reconnects automatically.
import {
  Refusal,
  type ErrorBody,
  type Fields,
  type Hello,
  type MachineEvent,
  type Picture,
  type Reply,
  type Role,
} from './contract';
import * as state from './state';

interface Waiting {
  resolve(reply: Reply): void;
  reject(why: Error): void;
}

const PERIOD_HZ = 20;
const GIVE_UP_MS = 15_000;
const SILENT_MS = 4_000;
const KEPT_EVENTS = 500;
const SHOWN_MS = 40;

let socket: WebSocket | null = null;
let next = 1;
let retry = 250;
let opened = 0;
let shown = 0;
const waiting = new Map<number, Waiting>();
const onLost = new Set<() => void>();
const onOpen = new Set<() => void>();
const onPicture = new Set<(picture: Picture) => void>();
const onEvent = new Set<(event: MachineEvent) => void>();

export const TOKEN_KEY = 'motionrack.token';

export const whenLost = (call: () => void): void => void onLost.add(call);
export const whenOpen = (call: () => void): void => void onOpen.add(call);
export const whenEvent = (call: (event: MachineEvent) => void): void => void onEvent.add(call);
export function whenPicture(call: (picture: Picture) => void): () => void {
  onPicture.add(call);
  return () => void onPicture.delete(call);
}

/** Sends one request and waits for its answer. Throws Refusal with the program's sentence. */
export function ask(fields: Fields, give_up_ms = GIVE_UP_MS): Promise<Reply> {
  const open = socket;
  if (open?.readyState !== WebSocket.OPEN)
    return Promise.reject(
      new Refusal({ kind: 'io', message: 'The page is not connected to the program. Nothing was sent.' }),
    );
  const id = next++;
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => {
      waiting.delete(id);
      reject(
        new Refusal({
          kind: 'io',
          message: `The program has not answered for ${give_up_ms / 1000} s. Check the machine's state before you try again.`,
        }),
      );
    }, give_up_ms);
    waiting.set(id, {
      resolve: (reply) => {
        clearTimeout(timer);
        resolve(reply);
      },
      reject: (why) => {
        clearTimeout(timer);
        reject(why);
      },
    });
    open.send(JSON.stringify({ id, ...fields }));
  });
}

function answered(message: Reply): void {
  const one = waiting.get(message.id as number);
  if (one === undefined) return;
  waiting.delete(message.id as number);
  if (message.error !== undefined) one.reject(new Refusal(message.error as ErrorBody));
  else one.resolve(message);
}

function heard(message: Record<string, unknown>): void {
  if (message.hello !== undefined) greeted(message.hello as Hello);
  else if (message.event !== undefined) addEvent(message.event as MachineEvent);
  else if (message.status !== undefined) seen(message as unknown as Picture);
  else if (message.id !== undefined) answered(message);
}

function seen(picture: Picture): void {
  state.received.value = performance.now();
  state.lost.value += picture.lost;
  // Panels with a hundred values per second must not redraw the whole page that often.
  const now = performance.now();
  if (now - shown > SHOWN_MS || state.status.peek()?.state !== picture.status.state) {
    shown = now;
    state.status.value = picture.status;
  }
  state.lookAtAge();
  for (const call of onPicture) call(picture);
}

export function addEvent(event: MachineEvent): void {
  const known = state.events.peek();
  if (known.some((one) => one.number === event.number)) return;
  state.events.value = [...known, event].sort((a, b) => a.number - b.number).slice(-KEPT_EVENTS);
  for (const call of onEvent) call(event);
}

function greeted(hello: Hello): void {
  const before = state.hello.peek();
  if (before !== null && before.boot !== hello.boot) state.events.value = [];
  state.hello.value = hello;
  state.role.value = hello.role;
  state.user.value = hello.user ?? '';
  retry = 250;
  void showToken();
}

/** Sends the stored token, if any; deletes a rejected token. */
export async function showToken(): Promise<void> {
  const token = localStorage.getItem(TOKEN_KEY);
  if (token !== null)
    try {
      const reply = await ask({ token });
      state.role.value = reply.role as Role;
      state.user.value = (reply.user as string | undefined) ?? '';
    } catch (why) {
      if (why instanceof Refusal && why.body.kind === 'denied') localStorage.removeItem(TOKEN_KEY);
    }
  for (const call of onOpen) call();
}

export const streamAddress = (): string =>
  `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/api/stream`;

function gone(which: WebSocket): void {
  if (which !== socket) return;
  socket = null;
  state.link.value = 'lost';
  for (const call of onLost) call();
  const why = new Refusal({
    kind: 'io',
    message:
      "The connection to the program was lost before it answered. Check the machine's state before you try again.",
  });
  for (const one of waiting.values()) one.reject(why);
  waiting.clear();
  setTimeout(connect, retry);
  retry = Math.min(retry * 2, 4000);
}

export function connect(): void {
  const one = new WebSocket(streamAddress());
  socket = one;
  opened = performance.now();
  one.onopen = () => {
    if (one === socket) state.link.value = 'open';
  };
  one.onmessage = (message) => {
    if (one === socket) heard(JSON.parse(message.data as string) as Record<string, unknown>);
  };
  one.onclose = () => gone(one);
}

/** Treats a silent connection as lost, even if it was not closed. */
function watchSilence(): void {
  const open = socket;
  if (open === null || document.hidden) return;
  const since = Math.max(opened, state.received.peek());
  if (performance.now() - since > SILENT_MS && open.readyState !== WebSocket.CLOSED) {
    open.onclose = null;
    open.close();
    gone(open);
  }
}
setInterval(watchSilence, 500);

export { PERIOD_HZ };
