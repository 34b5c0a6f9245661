// The keyboard: its table, and the handling of key events.
import { describe, expect, test } from 'vitest';
import { FakeElement, FakeInput, FakeSelect, FakeTextArea, after, type Browser, type Settings } from './browser';
import { axis, connected, type Program } from './program';

const table = async (): Promise<typeof import('../../src/keys/table')> => import('../../src/keys/table');
const lease = async (): Promise<typeof import('../../src/jog/lease')> => import('../../src/jog/lease');
const HOLD = { stored: { 'motionrack.jog.step': '5' } };

interface Press {
  target?: EventTarget;
  code?: string;
  altGraph?: boolean;
  ctrlKey?: boolean;
  altKey?: boolean;
  metaKey?: boolean;
  shiftKey?: boolean;
  repeat?: boolean;
  isComposing?: boolean;
}

/** Sends a key event. Returns true if the page handled it, so that no element receives it. */
function key(browser: Browser, kind: 'keydown' | 'keyup', name: string, press: Press = {}): boolean {
  const { target, altGraph, ...rest } = press;
  const none = { ctrlKey: false, altKey: false, metaKey: false, shiftKey: false, repeat: false, isComposing: false };
  const fields = { ...none, key: name, code: name, ...rest, getModifierState: () => altGraph === true };
  const event = Object.assign(new Event(kind, { cancelable: true }), fields);
  if (target !== undefined) Object.defineProperty(event, 'target', { value: target });
  return !browser.window.dispatchEvent(event);
}

async function listening(
  settings: Settings & Parameters<typeof connected>[0] = {},
): Promise<{ browser: Browser; program: Program }> {
  const all = await connected(settings);
  all.program.answers.jog = {};
  (await import('../../src/keys/handler')).listen();
  return all;
}

const commands = (program: Program): unknown[] => program.heard.map((one) => one.command).filter(Boolean);

describe('the table', () => {
  test('has each key once', async () => {
    await connected();
    const { JOG_KEYS, KEYS } = await table();
    const all = [...KEYS.flatMap((one) => one.keys), ...JOG_KEYS.flatMap((one) => one.keys)];
    expect(all).toHaveLength(new Set(all).size);
  });

  test.each([
    ['ArrowLeft', 'X', -1],
    ['ArrowRight', 'X', 1],
    ['ArrowDown', 'Y', -1],
    ['ArrowUp', 'Y', 1],
    ['PageDown', 'Z', -1],
    ['PageUp', 'Z', 1],
    ['[', 'A', -1],
    [']', 'A', 1],
    ['{', 'A', -1],
    ['}', 'A', 1],
  ])('%s jogs %s in the direction %d', async (name, letter, direction) => {
    await connected();
    expect((await table()).jogOf(name)).toEqual({ axis: letter, direction });
  });

  test('jogs no axis that the machine does not have, and nothing by another key', async () => {
    await connected({ machine: { axes: [axis('X'), axis('Y')] } });
    const { jogOf } = await table();
    expect(['PageUp', '[', 'x'].map(jogOf)).toEqual([null, null, null]);
  });

  test('has the first axis other than X, Y and Z on the brackets', async () => {
    await connected({ machine: { axes: ['X', 'C', 'B'].map((letter) => axis(letter)) } });
    expect((await table()).jogOf(']')).toEqual({ axis: 'C', direction: 1 });
  });
});

describe('the jog pad', () => {
  test.each([
    ['XYZA', { x: 'X', y: 'Y', columns: ['Z', 'A'] }],
    ['XZ', { x: 'X', columns: ['Z'] }],
    ['XYZABC', { x: 'X', y: 'Y', columns: ['Z', 'A', 'B', 'C'] }],
    ['UV', { columns: ['U', 'V'] }],
    ['', { columns: [] }],
  ])('has X and Y crosswise and every other axis in a column (%s)', async (letters, pad) => {
    await connected();
    expect((await table()).padOf([...letters])).toEqual(pad);
  });
});

describe('a key', () => {
  test.each([
    ['Escape', 'stop'],
    [' ', 'hold'],
    ['p', 'hold'],
    ['!', 'hold'],
    ['s', 'resume'],
    ['F1', 'set_estop'],
    ['F2', 'enable'],
    ['End', 'touch_off'],
  ])('"%s" sends the command %s', async (name, command) => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', name)).toBe(true);
    expect(commands(program)).toEqual([command]);
  });

  test.each([
    ['1', 0.1],
    ['9', 0.9],
    ['0', 1],
    ['`', 0],
  ])('"%s" sets the feed override to %d', async (name, feed) => {
    const { browser, program } = await listening();
    key(browser, 'keydown', name);
    expect(program.asked('set_overrides')).toEqual([{ command: 'set_overrides', feed }]);
  });

  test('acts only with Ctrl if the table has it with Ctrl, otherwise only without', async () => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', 'Home')).toBe(false);
    expect(key(browser, 'keydown', 's', { ctrlKey: true })).toBe(false);
    expect(key(browser, 'keydown', 'Home', { ctrlKey: true })).toBe(true);
    expect(commands(program)).toEqual(['home']);
  });

  test.each([{ altKey: true }, { metaKey: true }])('is left to the browser with %o', async (modifier) => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', 's', modifier)).toBe(false);
    expect(commands(program)).toEqual([]);
  });

  test('acts with AltGr, which some systems report as Ctrl and Alt', async () => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', '~', { altGraph: true, ctrlKey: true, altKey: true })).toBe(true);
    expect(commands(program)).toEqual([]);
    const { notices } = await import('../../src/link/commands');
    expect(notices.value[0]?.text).toMatch(/No program is open/);
  });
});

describe('the keyboard', () => {
  test('executes a repeating key once, and keeps it from the page', async () => {
    const { browser, program } = await listening();
    key(browser, 'keydown', ' ');
    expect(key(browser, 'keydown', ' ', { repeat: true })).toBe(true);
    expect(commands(program)).toEqual(['hold']);
  });

  test('ignores keys that compose a letter', async () => {
    const { browser, program } = await listening();
    key(browser, 'keydown', 's', { isComposing: true });
    expect(commands(program)).toEqual([]);
  });

  test('leaves keys outside of the table to the page', async () => {
    const { browser } = await listening();
    expect(key(browser, 'keydown', 'q')).toBe(false);
  });

  test('keeps the release of Space from buttons, but not from fields', async () => {
    const { browser } = await listening();
    expect(key(browser, 'keyup', ' ')).toBe(true);
    expect(key(browser, 'keyup', ' ', { target: new FakeInput() })).toBe(false);
  });
});

describe('a key of the page itself', () => {
  test('? opens the table and closes it', async () => {
    const { browser } = await listening();
    const { helpOpen } = await import('../../src/view');
    key(browser, 'keydown', '?');
    expect(helpOpen.value).toBe(true);
    key(browser, 'keydown', '?');
    expect(helpOpen.value).toBe(false);
  });

  test('Escape closes dialogs, and is STOP as well', async () => {
    const { browser, program } = await listening();
    const { dialogOpen, inviteOpen } = await import('../../src/link/pairing');
    dialogOpen.value = inviteOpen.value = true;
    key(browser, 'keydown', 'Escape');
    expect([dialogOpen.value, inviteOpen.value, commands(program)]).toEqual([false, false, ['stop']]);
  });

  test('i selects the next step, and c continuous jogging', async () => {
    const { browser } = await listening({ stored: { 'motionrack.jog.step': '3' } });
    const { STEPS, stepIndex } = await lease();
    const steps = ['i', 'i', 'i', 'c', 'i'].map((name) => (key(browser, 'keydown', name), STEPS[stepIndex.value]));
    expect(steps).toEqual([10, 0.001, 0.01, null, 0.01]);
  });
});

describe('while a field is typed in', () => {
  const button = Object.assign(new FakeInput(), { type: 'checkbox' });
  const free = Object.assign(new FakeElement(), { isContentEditable: true });

  test.each([
    ['an input', new FakeInput()],
    ['a text area', new FakeTextArea()],
    ['a list', new FakeSelect()],
    ['text that can be edited', free],
  ])('%s takes letters, and Escape, F1 and F2 act all the same', async (_, target) => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', 's', { target })).toBe(false);
    for (const name of ['Escape', 'F1', 'F2']) expect(key(browser, 'keydown', name, { target })).toBe(true);
    expect(commands(program)).toEqual(['stop', 'set_estop', 'enable']);
  });

  test.each([
    ['a check box', button],
    ['a button', new FakeElement()],
  ])('%s takes none', async (_, target) => {
    const { browser, program } = await listening();
    expect(key(browser, 'keydown', 's', { target })).toBe(true);
    expect(commands(program)).toEqual(['resume']);
  });

  test('arrows move the cursor, not the machine', async () => {
    const { browser, program } = await listening(HOLD);
    (await lease()).setArmed(true);
    expect(key(browser, 'keydown', 'ArrowLeft', { target: new FakeInput() })).toBe(false);
    expect(commands(program)).toEqual([]);
  });
});

describe('a jog key', () => {
  test('does nothing before the keyboard is armed', async () => {
    const { browser, program } = await listening(HOLD);
    expect(key(browser, 'keydown', 'ArrowRight')).toBe(false);
    expect(commands(program)).toEqual([]);
  });

  test('jogs while it is held, once armed', async () => {
    const { browser, program } = await listening(HOLD);
    (await lease()).setArmed(true);
    expect(key(browser, 'keydown', 'ArrowRight')).toBe(true);
    key(browser, 'keydown', 'ArrowRight', { repeat: true });
    expect(program.asked('jog')).toEqual([{ command: 'jog', axis: 'X', speed: 10, sequence: 1 }]);
    key(browser, 'keyup', 'ArrowRight');
    expect(program.asked('jog_stop')).toHaveLength(1);
  });

  test('makes one step per press, however long it repeats', async () => {
    const { browser, program } = await listening({ stored: { 'motionrack.jog.step': '2' } });
    (await lease()).setArmed(true);
    key(browser, 'keydown', 'ArrowRight');
    for (let i = 0; i < 5; ++i) expect(key(browser, 'keydown', 'ArrowRight', { repeat: true })).toBe(true);
    expect(commands(program)).toEqual(['jog_by']);
  });

  test('jogs at the maximum velocity while Shift is held', async () => {
    const { browser, program } = await listening(HOLD);
    (await lease()).setArmed(true);
    key(browser, 'keydown', 'ArrowRight', { shiftKey: true });
    expect(program.asked('jog').at(-1)?.speed).toBe(50);
    key(browser, 'keyup', 'Shift');
    await after(80);
    expect(program.asked('jog').at(-1)?.speed).toBe(10);
  });

  test('is released even if Shift changed its letter while it was held', async () => {
    const { browser, program } = await listening(HOLD);
    (await lease()).setArmed(true);
    key(browser, 'keydown', ']', { code: 'BracketRight' });
    key(browser, 'keyup', '}', { code: 'BracketRight' });
    expect(program.asked('jog_stop')).toHaveLength(1);
  });
});

describe('a jog key that may not jog', () => {
  test('is another key with Ctrl, Alt or Meta', async () => {
    const { browser, program } = await listening(HOLD);
    (await lease()).setArmed(true);
    for (const modifier of [{ ctrlKey: true }, { altKey: true }, { metaKey: true }])
      key(browser, 'keydown', 'ArrowRight', modifier);
    expect(commands(program)).toEqual([]);
  });

  test('reports once why it does not jog', async () => {
    const { browser, program } = await listening({ ...HOLD, machine: { control: { holder: 'bert' } } });
    (await lease()).setArmed(true);
    key(browser, 'keydown', 'ArrowRight');
    key(browser, 'keydown', 'ArrowRight', { repeat: true });
    const { notices } = await import('../../src/link/commands');
    expect(notices.value.map((one) => one.text)).toEqual(['Jog: bert holds control.']);
    expect(commands(program)).toEqual([]);
  });
});
