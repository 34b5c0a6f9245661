// Texts that the page stores: the program, and MDI lines.
import { describe, expect, test } from 'vitest';
import { openBrowser, settled, type Browser } from './browser';
import { connected, status, type Program } from './program';

const text = async (): Promise<typeof import('../../src/program/text')> => import('../../src/program/text');
const lines = async (): Promise<typeof import('../../src/panels/lines')> => import('../../src/panels/lines');
const stored = (browser: Browser): { stored: Record<string, string> } => ({
  stored: Object.fromEntries(browser.store),
});

describe('the program in the panel', () => {
  test('survives a reload, with its name', async () => {
    const browser = openBrowser();
    const { program, programName } = await text();
    expect([programName.value, program.value]).toEqual(['program.ngc', '']);
    programName.value = 'part.ngc';
    program.value = 'G0 X1';
    openBrowser(stored(browser));
    const again = await text();
    expect([again.programName.value, again.program.value]).toEqual(['part.ngc', 'G0 X1']);
  });

  test('is not stored in part, nor is the previous one kept, if it exceeds the browser’s store', async () => {
    const browser = openBrowser();
    const { program } = await text();
    program.value = 'G0 X1';
    program.value = 'G'.repeat(2_000_001);
    expect(browser.store.has('motionrack.program')).toBe(false);
    expect(program.value).toHaveLength(2_000_001);
  });

  test('stays in the panel if the browser’s store is full', async () => {
    openBrowser();
    const { program } = await text();
    localStorage.setItem = () => {
      throw new Error('QuotaExceededError');
    };
    program.value = 'G0 X1';
    expect(program.value).toBe('G0 X1');
  });
});

describe('the program that runs', () => {
  const runs = { ...status().program, name: 'other.ngc', runs: true };
  const answer = { name: 'other.ngc', text: 'G1 X5' };

  test('is requested, whichever tab started it, and discarded when it ends', async () => {
    const { program } = await connected();
    program.answers.program = answer;
    const { running } = await text();
    program.show({ state: 'moving', program: runs });
    await settled();
    expect(running.value).toMatchObject(answer);
    program.show({ state: 'standstill', program: { ...runs, runs: false } });
    expect(running.value).toBeNull();
  });

  test('is requested once and not with every snapshot', async () => {
    const { program } = await connected();
    program.answers.program = answer;
    await text();
    program.show({ state: 'moving', program: runs });
    program.show({ state: 'hold', program: { ...runs, line: 2 } });
    await settled();
    expect(program.asked('program')).toHaveLength(1);
  });
});

const opened = async (): Promise<{ browser: Browser; program: Program; mdi: Awaited<ReturnType<typeof lines>> }> => ({
  ...(await connected()),
  mdi: await lines(),
});
const send = async (mdi: Awaited<ReturnType<typeof lines>>, line: string): Promise<void> => {
  mdi.draft.value = line;
  await mdi.send();
};

describe('an MDI line', () => {
  test('is sent without surrounding blanks, and leaves an empty field', async () => {
    const { mdi, program } = await opened();
    program.answers.mdi = {};
    await send(mdi, '  G0 X1 ');
    expect(program.asked('mdi')).toEqual([{ command: 'mdi', text: 'G0 X1' }]);
    expect(mdi.draft.value).toBe('');
    expect(mdi.log.value).toEqual([{ text: 'G0 X1', answer: 'ok', good: true }]);
  });

  test('waits for its answer, which is shown at its own line', async () => {
    const { mdi, program } = await opened();
    const [first, second] = ['G0 X1', 'G0 X2'].map((line) => send(mdi, line));
    expect(mdi.log.value.map((one) => one.answer)).toEqual(['…', '…']);
    const [one, two] = program.heard.slice(-2);
    program.say({ id: two?.id });
    await second;
    expect(mdi.log.value.map((each) => each.answer)).toEqual(['…', 'ok']);
    program.say({ id: one?.id, error: { kind: 'refused', message: 'X is at its limit.' } });
    await first;
    expect(mdi.log.value[0]).toEqual({ text: 'G0 X1', answer: 'X is at its limit.', good: false });
  });

  test('is not sent if it is empty', async () => {
    const { mdi, program } = await opened();
    await send(mdi, '   ');
    expect([program.asked('mdi'), mdi.log.value]).toEqual([[], []]);
  });
});

describe('the history of lines', () => {
  test('is recalled by Up and left by Down', async () => {
    const { mdi, program } = await opened();
    program.answers.mdi = {};
    for (const line of ['one', 'two', 'three']) await send(mdi, line);
    const seen = [1, 1, 1, 1, -1, -1, -1, -1].map((by) => (mdi.walk(by), mdi.draft.value));
    expect(seen).toEqual(['three', 'two', 'one', 'one', 'two', 'three', '', '']);
  });

  test('has a repeated line once, as the newest', async () => {
    const { mdi, program } = await opened();
    program.answers.mdi = {};
    for (const line of ['one', 'two', 'one']) await send(mdi, line);
    const seen = [1, 1, 1].map((by) => (mdi.walk(by), mdi.draft.value));
    expect(seen).toEqual(['one', 'two', 'two']);
  });

  test('survives a reload, with the newest 100 lines', async () => {
    const { browser, mdi, program } = await opened();
    program.answers.mdi = {};
    for (let i = 1; i <= 101; ++i) await send(mdi, `G0 X${i}`);
    expect(mdi.log.value).toHaveLength(100);
    openBrowser(stored(browser));
    const again = await lines();
    again.walk(1);
    expect(again.draft.value).toBe('G0 X101');
    again.walk(200);
    expect(again.draft.value).toBe('G0 X2');
  });

  test('begins at its newest line again after a line was sent', async () => {
    const { mdi, program } = await opened();
    program.answers.mdi = {};
    for (const line of ['one', 'two', 'three']) await send(mdi, line);
    mdi.walk(2);
    await mdi.send();
    mdi.walk(1);
    expect(mdi.draft.value).toBe('two');
    mdi.walk(1);
    expect(mdi.draft.value).toBe('three');
  });

  test('recalls nothing if it is empty', async () => {
    const { mdi } = await opened();
    mdi.walk(1);
    expect(mdi.draft.value).toBe('');
  });
});
