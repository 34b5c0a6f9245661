// Fake program at the other end of the page's socket: records the page's messages and sends the answers of a test.
import type { AxisStatus, Hello, Role, Status } from '../../src/link/contract';
import { after, openBrowser, settled, FakeSocket, type Browser, type Settings } from './browser';

type Message = Record<string, unknown> & { id: number };
/** Answer to a message; a text is a rejection with that sentence. */
type Answer = Record<string, unknown> | string;

export const axis = (letter: string, part: Partial<AxisStatus> = {}): AxisStatus => ({
  letter,
  unit: letter === 'A' ? 'deg' : 'mm',
  position_valid: true,
  enabled: true,
  can_home: true,
  commanded: 0,
  actual: 0,
  error: 0,
  velocity: 0,
  pulses: 0,
  counts: 0,
  min: 0,
  max: 100,
  max_velocity: 50,
  leds: {},
  ...part,
});

export const status = (part: Partial<Status> = {}): Status => ({
  at: 1,
  sequence: 1,
  state: 'standstill',
  reason: '',
  simulation: true,
  clock: { mode: 'real', factor: 1, late_ms: 0 },
  estop: { wired: true, pressed: false },
  control: { holder: 'anna', holder_session: 'this tab' },
  axes: ['X', 'Y', 'Z', 'A'].map((letter) => axis(letter)),
  program: { name: '', runs: false, line: 0, lines: 0, remaining_s: null, single_block: false },
  overrides: { feed: 1, rapid: 1 },
  alarms: [],
  ...part,
});

const hello = (part: Partial<Hello> = {}): Hello => ({
  version: '1.2.3',
  rack: 'bench',
  boot: 'first',
  role: 'maintain',
  simulation: true,
  session: 'this tab',
  user: 'anna',
  ...part,
});

export class Program {
  readonly heard: Message[] = [];
  /** Answers by the name of the command or query, `token` or `subscribe`; messages of other names get no answer. */
  readonly answers: Record<string, Answer | ((message: Message) => Answer)> = { subscribe: {} };
  private now = status();
  private sequence = 0;

  constructor(private readonly socket: FakeSocket) {
    socket.onsent = (text) => this.hear(JSON.parse(text) as Message);
  }

  private hear(message: Message): void {
    this.heard.push(message);
    const answer = this.answers[nameOf(message)];
    if (answer !== undefined) queueMicrotask(() => this.reply(message, answer));
  }

  private reply(message: Message, answer: Answer | ((message: Message) => Answer)): void {
    const one = typeof answer === 'function' ? answer(message) : answer;
    this.say({ id: message.id, ...(typeof one === 'string' ? { error: { kind: 'refused', message: one } } : one) });
  }

  say(message: Record<string, unknown>): void {
    if (this.socket.readyState === FakeSocket.OPEN) this.socket.onmessage?.({ data: JSON.stringify(message) });
  }

  greet(part: Partial<Hello> = {}): void {
    this.socket.readyState = FakeSocket.OPEN;
    this.socket.onopen?.();
    this.say({ hello: hello(part) });
  }

  /** Sends a snapshot whose status is the previous one with `part` changed. */
  show(part: Partial<Status> = {}, values?: (number | null)[], lost = 0): void {
    this.now = { ...this.now, ...part };
    this.say({ seq: ++this.sequence, lost, at: this.now.at, status: this.now, ...(values && { values }) });
  }

  /** Returns the messages of this name, without their ids. */
  asked(name: string): Record<string, unknown>[] {
    return this.heard.filter((one) => nameOf(one) === name).map(({ id: _, ...fields }) => fields);
  }
}

const nameOf = (message: Message): string => {
  const name = message.command ?? message.query;
  if (typeof name === 'string') return name;
  return message.token === undefined ? 'subscribe' : 'token';
};

/** Opens a page, connects it and sends a first snapshot. */
export async function connected(
  settings: Settings & { role?: Role; greeting?: Partial<Hello>; machine?: Partial<Status> } = {},
): Promise<{ browser: Browser; program: Program }> {
  const browser = openBrowser(settings);
  const { connect } = await import('../../src/link/socket');
  connect();
  const program = new Program(browser.socket);
  program.greet({ ...(settings.role && { role: settings.role }), ...settings.greeting });
  await settled();
  program.show(settings.machine);
  await after(50);
  return { browser, program };
}
