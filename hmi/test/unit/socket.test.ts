// The connection to the program: requests and answers, snapshots, events, loss of the connection.
import { describe, expect, test } from 'vitest';
import { after, FakeSocket, openBrowser, settled } from './browser';
import { connected, Program, status } from './program';

const link = async (): Promise<typeof import('../../src/link/socket')> => import('../../src/link/socket');
const state = async (): Promise<typeof import('../../src/link/state')> => import('../../src/link/state');
const event = (number: number): Record<string, unknown> => ({
  number,
  at: number,
  kind: 'state',
  text: `event ${number}`,
});

describe('the address of the stream', () => {
  test('is the page’s own, plain or encrypted as the page is', async () => {
    openBrowser();
    expect((await link()).streamAddress()).toBe('ws://rack.test:8080/api/stream');
    openBrowser({ secure: true });
    expect((await link()).streamAddress()).toBe('wss://rack.test:8080/api/stream');
  });
});

describe('a query', () => {
  test('gets its own answer, in any order of answers', async () => {
    const { program } = await connected();
    const { ask } = await link();
    const [first, second] = [ask({ query: 'rack' }), ask({ query: 'path' })];
    const [one, two] = program.heard.slice(-2);
    program.say({ id: two?.id, text: 'second' });
    program.say({ id: one?.id, text: 'first' });
    expect((await first).text).toBe('first');
    expect((await second).text).toBe('second');
  });

  test('throws the reason of a refusal', async () => {
    const { program } = await connected();
    program.answers.home = 'The drives are disabled. Enable them first.';
    await expect((await link()).ask({ command: 'home' })).rejects.toThrow(
      'The drives are disabled. Enable them first.',
    );
  });

  test('is not sent without a connection, and reports it', async () => {
    openBrowser();
    await expect((await link()).ask({ command: 'home' })).rejects.toThrow('Nothing was sent.');
  });

  test('times out after 15 s, and a late answer changes nothing', async () => {
    const { program } = await connected();
    const answer = (await link()).ask({ command: 'home' });
    const failed = expect(answer).rejects.toThrow('not answered for 15 s');
    for (let s = 0; s < 15; ++s) {
      program.show();
      await after(1000);
    }
    await failed;
    program.say({ id: program.heard.at(-1)?.id });
  });

  test('does not time out after its answer', async () => {
    const { program } = await connected();
    program.answers.home = { done: true };
    await expect((await link()).ask({ command: 'home' })).resolves.toMatchObject({ done: true });
    for (let s = 0; s < 20; ++s) {
      program.show();
      await after(1000);
    }
    expect((await state()).link.value).toBe('open');
  });

  test('fails when the connection is lost before its answer', async () => {
    const { browser } = await connected();
    const answer = (await link()).ask({ command: 'home' });
    browser.socket.close();
    await expect(answer).rejects.toThrow('lost before it answered');
  });
});

describe('a lost connection', () => {
  test('is retried after 250 ms, then after twice as long, up to 4 s', async () => {
    const { browser } = await connected();
    for (const wait of [250, 500, 1000, 2000, 4000, 4000]) {
      const before = browser.connections;
      browser.socket.close();
      await after(wait - 1);
      expect(browser.connections).toBe(before);
      await after(1);
      expect(browser.connections).toBe(before + 1);
    }
  });

  test('is retried soon after a connection that was greeted', async () => {
    const { browser } = await connected();
    browser.socket.close();
    await after(250);
    browser.socket.close();
    await after(500);
    new Program(browser.socket).greet();
    const before = browser.connections;
    browser.socket.close();
    await after(250);
    expect(browser.connections).toBe(before + 1);
  });

  test('is detected after 4 s of silence, even if it was not closed', async () => {
    const { browser } = await connected();
    await after(3900);
    expect((await state()).link.value).toBe('open');
    await after(1000);
    expect((await state()).link.value).not.toBe('open');
    expect(browser.connections).toBeGreaterThan(1);
  });

  test('is not detected while the page is hidden, because browsers suspend it', async () => {
    const { browser } = await connected();
    browser.hide(true);
    await after(10_000);
    expect(browser.connections).toBe(1);
  });
});

describe('a closed connection', () => {
  test('notifies its listeners once', async () => {
    const { browser } = await connected();
    let times = 0;
    (await link()).whenLost(() => ++times);
    browser.socket.close();
    expect(times).toBe(1);
    expect((await state()).link.value).toBe('lost');
  });

  test('is ignored: messages of an old socket have no effect', async () => {
    const { browser } = await connected({ machine: { state: 'standstill' } });
    browser.socket.close();
    browser.socket.readyState = FakeSocket.OPEN;
    const old = browser.socket;
    await after(250);
    old.onmessage?.({ data: JSON.stringify({ seq: 9, lost: 0, at: 9, status: status({ state: 'moving' }) }) });
    expect((await state()).machineState.value).toBe('standstill');
  });
});

describe('status messages', () => {
  test('show the machine', async () => {
    await connected({ machine: { state: 'hold' } });
    expect((await state()).machineState.value).toBe('hold');
  });

  test('are skipped by panels that draw more slowly, and delivered to subscribers of each', async () => {
    const { program } = await connected();
    const seen: number[] = [];
    (await link()).whenPicture((picture) => seen.push(picture.at));
    for (const at of [2, 3, 4]) program.show({ at });
    expect(seen).toEqual([2, 3, 4]);
    expect((await state()).status.value?.at).toBe(2);
  });

  test('are shown at once if the machine’s state has changed', async () => {
    const { program } = await connected();
    program.show({ at: 2 });
    program.show({ at: 3, state: 'moving' });
    expect((await state()).machineState.value).toBe('moving');
  });

  test('reach a panel until it is closed', async () => {
    const { program } = await connected();
    let times = 0;
    const close = (await link()).whenPicture(() => ++times);
    program.show();
    close();
    program.show();
    expect(times).toBe(1);
  });

  test('are counted if the program skipped them', async () => {
    const { program } = await connected();
    program.show({}, undefined, 3);
    program.show({}, undefined, 2);
    expect((await state()).lost.value).toBe(5);
  });
});

describe('events', () => {
  test('are kept in their order, each once', async () => {
    const { program } = await connected();
    const heard: number[] = [];
    (await link()).whenEvent((one) => heard.push(one.number));
    for (const number of [2, 1, 2, 3]) program.say({ event: event(number) });
    expect((await state()).events.value.map((one) => one.number)).toEqual([1, 2, 3]);
    expect(heard).toEqual([2, 1, 3]);
  });

  test('are limited to the newest 500', async () => {
    const { program } = await connected();
    for (let number = 1; number <= 502; ++number) program.say({ event: event(number) });
    const kept = (await state()).events.value;
    expect([kept.length, kept[0]?.number, kept.at(-1)?.number]).toEqual([500, 3, 502]);
  });

  test('are kept apart from those before a restart of the program', async () => {
    const { program } = await connected();
    program.say({ event: event(7) });
    program.greet();
    expect((await state()).events.value).toHaveLength(1);
    program.greet({ boot: 'second' });
    expect((await state()).events.value).toEqual([]);
  });
});

describe('the user of this browser', () => {
  test('is named by the greeting', async () => {
    await connected({ role: 'observe', greeting: { user: 'bert' } });
    const { role, user } = await state();
    expect([role.value, user.value]).toEqual(['observe', 'bert']);
  });

  test('is named by the stored token', async () => {
    const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
    (await link()).connect();
    const program = new Program(browser.socket);
    program.answers.token = { role: 'operate', user: 'carl' };
    program.greet({ role: 'none', user: '' });
    await settled();
    const { role, user } = await state();
    expect(program.asked('token')).toEqual([{ token: 'T1' }]);
    expect([role.value, user.value]).toEqual(['operate', 'carl']);
  });

  test('loses an invalid token, and keeps one that could not be checked', async () => {
    for (const [kind, left] of [
      ['denied', undefined],
      ['machine', 'T1'],
    ] as const) {
      const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
      (await link()).connect();
      const program = new Program(browser.socket);
      program.answers.token = () => ({ error: { kind, message: 'no' } });
      program.greet();
      await settled();
      expect(browser.store.get('motionrack.token')).toBe(left);
    }
  });

  test('is known before panels send their first query', async () => {
    const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
    const { connect, whenOpen, ask } = await link();
    whenOpen(() => void ask({ query: 'rack' }).catch(() => undefined));
    connect();
    const program = new Program(browser.socket);
    program.answers.token = { role: 'operate', user: 'carl' };
    program.greet();
    await settled();
    expect(program.heard.map((one) => one.query ?? Object.keys(one).at(-1))).toEqual(['token', 'rack']);
  });
});
