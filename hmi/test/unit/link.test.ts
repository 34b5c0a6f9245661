// Channels, control, the rack and earlier events, over the connection.
import { describe, expect, test } from 'vitest';
import { after, settled } from './browser';
import { connected } from './program';

const channels = async (): Promise<typeof import('../../src/link/channels')> => import('../../src/link/channels');
const control = async (): Promise<typeof import('../../src/link/control')> => import('../../src/link/control');

describe('channels', () => {
  test('are one subscription for all panels, at the highest rate of them', async () => {
    const { program } = await connected();
    const { want } = await channels();
    want(['X.error', 'limit.x'], 10);
    want(['limit.x', 'mcx.CV'], 100);
    await settled();
    expect(program.asked('subscribe')).toEqual([
      { subscribe: { channels: ['X.error', 'limit.x', 'mcx.CV'], rate_hz: 100 } },
    ]);
  });

  test('come 20 times a second at least', async () => {
    const { program } = await connected();
    (await channels()).want(['X.error'], 5);
    await settled();
    expect(program.asked('subscribe').at(-1)).toEqual({ subscribe: { channels: ['X.error'], rate_hz: 20 } });
  });

  test('end with their panel', async () => {
    const { program } = await connected();
    const { want } = await channels();
    const close = want(['mcx.CV'], 100);
    want(['X.error']);
    await settled();
    close();
    await settled();
    expect(program.asked('subscribe').at(-1)).toEqual({ subscribe: { channels: ['X.error'], rate_hz: 20 } });
  });

  test('are 64 at most', async () => {
    const { program } = await connected();
    (await channels()).want(Array.from({ length: 70 }, (_, i) => `c${i}`));
    await settled();
    const { subscribe } = program.asked('subscribe').at(-1) as { subscribe: { channels: string[] } };
    expect([subscribe.channels.length, subscribe.channels.at(-1)]).toEqual([64, 'c63']);
  });

  test('are subscribed again after a reconnection', async () => {
    const { program } = await connected();
    (await channels()).want(['X.error']);
    await settled();
    program.greet();
    await settled();
    expect(program.asked('subscribe')).toHaveLength(2);
  });
});

describe('values of channels', () => {
  test('are those of the newest status message, in the order of the subscription', async () => {
    const { program } = await connected();
    const { channel, want } = await channels();
    want(['X.error', 'limit.x']);
    expect(channel('X.error').value).toBeNull();
    await settled();
    program.show({}, [0.25, 1]);
    expect([channel('X.error').value, channel('limit.x').value]).toEqual([0.25, 1]);
    program.show({}, [null, 0]);
    expect([channel('X.error').value, channel('limit.x').value]).toEqual([null, 0]);
  });

  test('stay if a status message belongs to another subscription, or has none', async () => {
    const { program } = await connected();
    const { channel, want } = await channels();
    want(['X.error', 'limit.x']);
    await settled();
    program.show({}, [0.25, 1]);
    program.show({}, [7]);
    program.show();
    expect([channel('X.error').value, channel('limit.x').value]).toEqual([0.25, 1]);
  });

  test('are not read from status messages after a subscription was refused', async () => {
    const { program } = await connected();
    const { channel, want } = await channels();
    want(['X.error']);
    await settled();
    program.answers.subscribe = 'Unknown channel X.eror.';
    want(['X.eror']);
    await settled();
    program.show({}, [3]);
    program.show({}, [3, 4]);
    expect([channel('X.error').value, channel('X.eror').value]).toEqual([null, null]);
  });
});

describe('control', () => {
  test('is taken without force if it is free', async () => {
    const { program } = await connected({ machine: { control: { holder: null } } });
    const { takeControl, whyNotControl } = await control();
    expect(whyNotControl()).toBe('');
    takeControl();
    expect(program.asked('take_control')).toEqual([{ command: 'take_control' }]);
  });

  test.each(['standstill', 'hold'])('is taken from another user by force, at %s', async (state) => {
    const { program } = await connected({ machine: { state, control: { holder: 'bert', holder_session: 's' } } });
    const { takeControl, whyNotControl } = await control();
    expect(whyNotControl()).toBe('');
    takeControl();
    expect(program.asked('take_control')).toEqual([{ command: 'take_control', force: true }]);
  });

  test('is not taken from another user while the machine moves', async () => {
    await connected({ machine: { state: 'moving', control: { holder: 'bert', holder_session: 's' } } });
    expect((await control()).whyNotControl()).toMatch(/^bert holds control and the machine moves/);
  });

  test('passes from one tab of a user to another while the machine moves, without force', async () => {
    const { program } = await connected({
      machine: { state: 'moving', control: { holder: 'anna', holder_session: 'another tab' } },
    });
    const { takeControl, whyNotControl } = await control();
    expect(whyNotControl()).toBe('');
    takeControl();
    expect(program.asked('take_control')).toEqual([{ command: 'take_control' }]);
  });

  test('needs the role operate', async () => {
    await connected({ role: 'observe', machine: { control: { holder: null } } });
    expect((await control()).whyNotControl()).toMatch(/needs the role operate/);
  });

  test('is released', async () => {
    const { program } = await connected();
    (await control()).releaseControl();
    expect(program.asked('release_control')).toHaveLength(1);
  });

  test('is renewed every 3 s, only by the tab that holds it', async () => {
    const { program } = await connected();
    (await control()).keepControl();
    const wait = async (): Promise<void> => {
      program.show();
      await after(3000);
    };
    await wait();
    await wait();
    expect(program.asked('renew_control')).toHaveLength(2);
    program.show({ state: 'hold', control: { holder: 'anna', holder_session: 'another tab' } });
    await wait();
    expect(program.asked('renew_control')).toHaveLength(2);
  });
});

describe('the rack', () => {
  const mcx = { name: 'mcx', type: 'mcx314' };

  test('is queried once per connection, with its channels', async () => {
    const { program } = await connected();
    const { cardNamed, channelNames, rack } = await import('../../src/link/rack');
    expect(rack.value).toBeNull();
    program.answers.rack = { name: 'bench', cards: [mcx] };
    program.answers.channels = { channels: [{ name: 'X.error', unit: 'mm', text: '' }] };
    program.greet();
    await settled();
    expect(cardNamed('mcx')).toMatchObject(mcx);
    expect(cardNamed('rtc')).toBeUndefined();
    expect([...channelNames.value]).toEqual(['X.error']);
  });

  test('is unknown if the program rejects the query, without an error', async () => {
    const { program } = await connected();
    const { rack } = await import('../../src/link/rack');
    program.answers.rack = 'not now';
    program.greet();
    await settled();
    expect(rack.value).toBeNull();
  });
});

describe('the history', () => {
  const load = async (): Promise<void> => (await import('../../src/link/history')).loadHistory();
  const numbers = async (): Promise<number[]> =>
    (await import('../../src/link/state')).events.value.map((one) => one.number);

  test('precedes the events since the page was opened', async () => {
    const { program } = await connected();
    program.answers.events = { events: [1, 2, 3].map((number) => ({ number, at: 0, kind: 'state', text: '' })) };
    program.say({ event: { number: 3, at: 1, kind: 'state', text: '' } });
    program.say({ event: { number: 4, at: 1, kind: 'state', text: '' } });
    await load();
    expect(program.asked('events')).toEqual([{ query: 'events', limit: 200 }]);
    expect(await numbers()).toEqual([1, 2, 3, 4]);
  });

  test('is empty if the program does not report it', async () => {
    const { program } = await connected();
    program.answers.events = 'not for you';
    await load();
    expect(await numbers()).toEqual([]);
  });
});
