// Commands: rejections are shown, each command has a reason if it is not allowed, STOP is sent over stream and HTTP.
import { describe, expect, test } from 'vitest';
import type { Role } from '../../src/link/contract';
import { after, openBrowser, settled } from './browser';
import { connected } from './program';

const commands = async (): Promise<typeof import('../../src/link/commands')> => import('../../src/link/commands');
const texts = async (): Promise<string[]> => (await commands()).notices.value.map((one) => one.text);

describe('a command', () => {
  test('is sent with its fields, and returns true when it was accepted', async () => {
    const { program } = await connected();
    program.answers.home = { done: true };
    expect(await (await commands()).command('home', { axes: 'X' })).toBe(true);
    expect(program.asked('home')).toEqual([{ command: 'home', axes: 'X' }]);
  });

  test('is not changed into another one by its fields', async () => {
    const { program } = await connected();
    program.answers.home = {};
    await (await commands()).command('home', { command: 'stop' });
    expect(program.heard.at(-1)?.command).toBe('home');
  });

  test('returns false if it is refused, and shows the reason', async () => {
    const { program } = await connected();
    program.answers.home = 'X has no home switch.';
    expect(await (await commands()).command('home')).toBe(false);
    expect(await texts()).toEqual(['X has no home switch.']);
  });

  test('returns its answer, or null if it was refused', async () => {
    const { program } = await connected();
    program.answers.invite = { code: 'ABCD' };
    program.answers.mark = 'no';
    expect(await (await commands()).commandFor('invite')).toMatchObject({ code: 'ABCD' });
    expect(await (await commands()).commandFor('mark')).toBeNull();
  });
});

describe('a sentence', () => {
  test('names line and column if the program did', async () => {
    openBrowser();
    const { Refusal } = await import('../../src/link/contract');
    const { sentence } = await commands();
    const said = (place: object): string =>
      sentence(new Refusal({ kind: 'refused', message: 'G99 is unknown.', ...place }));
    expect(said({ line: 3, column: 7 })).toBe('Line 3, column 7: G99 is unknown.');
    expect(said({ line: 3 })).toBe('Line 3: G99 is unknown.');
    expect(said({ line: 3, column: 0 })).toBe('Line 3: G99 is unknown.');
    expect(said({ line: 0, column: 7 })).toBe('G99 is unknown.');
    expect(said({})).toBe('G99 is unknown.');
  });

  test('is the text of any other error', async () => {
    openBrowser();
    const { sentence } = await commands();
    expect(sentence(new Error('broken'))).toBe('broken');
    expect(sentence('odd')).toBe('odd');
  });
});

describe('notices', () => {
  test('disappear: confirmations after 4 s, rejections after 12 s', async () => {
    openBrowser();
    const { notice } = await commands();
    notice('done', 'paired');
    notice('refused', 'no');
    await after(3999);
    expect(await texts()).toEqual(['paired', 'no']);
    await after(1);
    expect(await texts()).toEqual(['no']);
    await after(8000);
    expect(await texts()).toEqual([]);
  });

  test('are four at most, the newest last', async () => {
    openBrowser();
    const { notice } = await commands();
    for (const text of ['1', '2', '3', '4', '5']) notice('refused', text);
    expect(await texts()).toEqual(['2', '3', '4', '5']);
  });

  test('appear once for the same text', async () => {
    openBrowser();
    const { notice } = await commands();
    for (const text of ['a', 'b', 'a']) notice('refused', text);
    expect(await texts()).toEqual(['b', 'a']);
  });

  test('can be closed by hand', async () => {
    openBrowser();
    const { dismiss, notice, notices } = await commands();
    notice('refused', 'a');
    notice('refused', 'b');
    dismiss(notices.value[0]?.key ?? 0);
    expect(await texts()).toEqual(['b']);
  });
});

describe('STOP', () => {
  test('is sent by the stream and by HTTP', async () => {
    const { browser, program } = await connected();
    (await commands()).stop();
    await settled();
    expect(program.asked('stop')).toHaveLength(1);
    expect(browser.posts.map((one) => one.path)).toEqual(['api/stop']);
    expect(await texts()).toEqual([]);
  });

  test('is sent by HTTP with the name of the user', async () => {
    const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
    (await commands()).stop();
    await settled();
    expect(browser.posts.map((one) => one.authorization)).toEqual(['Bearer T1']);
  });

  test('is sent by HTTP without a stream, and shows no notice on success', async () => {
    const browser = openBrowser();
    (await commands()).stop();
    await settled();
    expect(browser.posts).toHaveLength(1);
    expect(await texts()).toEqual([]);
  });

  test.each([
    ['the program did not take it', { ok: false, status: 500, body: {} }],
    ['there is no connection', new Error('offline')],
  ])('points to the real emergency stop when %s', async (_, http) => {
    const browser = openBrowser();
    browser.http = http;
    (await commands()).stop();
    await settled();
    expect((await texts()).join()).toMatch(/^STOP did not reach the program.*use its emergency stop\.$/);
  });
});

describe('the reason of a refusal', () => {
  test('reports a missing connection first', async () => {
    openBrowser();
    expect((await commands()).whyNot('observe')).toBe('The page is not connected to the program.');
  });

  test.each([
    ['none', [false, false, false]],
    ['observe', [true, false, false]],
    ['operate', [true, true, false]],
    ['maintain', [true, true, true]],
  ] as [Role, boolean[]][])('includes the lower roles in the role %s', async (role, expected) => {
    await connected({ role });
    const { hasRole } = await commands();
    expect((['observe', 'operate', 'maintain'] as const).map(hasRole)).toEqual(expected);
  });

  test('names the required role and the present one', async () => {
    await connected({ role: 'observe' });
    expect((await commands()).whyNot('operate')).toMatch(/needs the role operate; you have the role observe\./);
  });

  test('requests pairing from an unpaired browser', async () => {
    await connected({ role: 'none' });
    expect((await commands()).whyNot('observe')).toMatch(/you are not paired\. Pair this browser/);
  });

  test('names the holder of control if control is needed', async () => {
    const { program } = await connected({ machine: { control: { holder: 'bert', holder_session: 'another' } } });
    const { mayOperate, whyNot } = await commands();
    expect(whyNot('operate')).toBe('');
    expect(mayOperate()).toBe('bert holds control.');
    program.show({ state: 'hold', control: { holder: null } });
    expect(mayOperate()).toBe('Take control first.');
  });

  test('is empty for the tab that holds control', async () => {
    await connected();
    const { mayMaintain, mayOperate } = await commands();
    expect([mayOperate(), mayMaintain()]).toEqual(['', '']);
  });

  test('names the card in service', async () => {
    const { program } = await connected();
    const { whyInService } = await commands();
    expect(whyInService()).toBe('');
    program.show({ state: 'service', service: 'motion' });
    expect(whyInService()).toBe('Card motion is in service: nothing else drives the machine. End the service first.');
    program.show({ state: 'standstill', service: '' });
    expect(whyInService()).toBe('');
  });
});
