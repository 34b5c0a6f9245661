// The planned and the actual path, in the order of the page's axes.
import { describe, expect, test } from 'vitest';
import { after, settled, type Browser } from './browser';
import { axis, connected, type Program } from './program';

type Data = typeof import('../../src/path/data');

async function following(
  letters = 'XYZ',
): Promise<{ browser: Browser; program: Program; data: Data; stop: () => void }> {
  const { browser, program } = await connected({ machine: { axes: [...letters].map((letter) => axis(letter)) } });
  program.answers.path = { number: 0, axes: letters, driven: [] };
  const data = await import('../../src/path/data');
  const stop = data.follow();
  await settled();
  return { browser, program, data, stop };
}

/** Sets the answer to the next query of the path and waits for it. */
async function next(program: Program, answer: Record<string, unknown>): Promise<void> {
  program.answers.path = { number: 0, axes: 'XYZ', driven: [], ...answer };
  program.show();
  await after(200);
}

describe('the planned path', () => {
  const plan = [
    [1, 2, 3],
    [4, 5, 6],
  ];

  test('has the order of the page’s axes', async () => {
    const { data, program } = await following('XYZ');
    await next(program, { number: 1, axes: 'ZYX', planned: plan });
    expect(data.planned.value).toEqual([
      [3, 2, 1],
      [6, 5, 4],
    ]);
    expect(data.plannedIs.value).toBe('running');
  });

  test('is 0 in an axis that the program does not name', async () => {
    const { data, program } = await following('XYA');
    await next(program, { number: 1, axes: 'XY', planned: plan });
    expect(data.planned.value).toEqual([
      [1, 2, 0],
      [4, 5, 0],
    ]);
  });

  test('is requested by its number, and sent again only if it has changed', async () => {
    const { data, program } = await following();
    await next(program, { number: 4, planned: plan });
    await next(program, { number: 4, planned: null });
    expect(program.asked('path').map((one) => one.have)).toEqual([0, 0, 4]);
    expect(data.planned.value).toHaveLength(2);
  });

  test('keeps the previous one instead of a single point', async () => {
    const { data, program } = await following();
    await next(program, { number: 1, planned: plan });
    await next(program, { number: 2, planned: [[9, 9, 9]] });
    expect(data.planned.value).toHaveLength(2);
  });

  test('shows a checked program until another one runs', async () => {
    const { data, program } = await following();
    const { checked } = await import('../../src/path/checked');
    checked.value = { ok: true, problems: [], lines: 2, axes: 'YX', path: plan };
    expect(data.planned.value).toEqual([
      [2, 1, 0],
      [5, 4, 0],
    ]);
    expect(data.plannedIs.value).toBe('checked');
    await next(program, { number: 0, planned: plan });
    expect(data.plannedIs.value).toBe('checked');
    await next(program, { number: 1, planned: plan });
    expect(data.plannedIs.value).toBe('running');
  });
});

describe('the actual path', () => {
  test('grows by the points since its last one', async () => {
    const { data, program } = await following();
    await next(program, { driven: [[1, 10, 20, 30]], errors: [0.5] });
    await next(program, { driven: [[2, 11, 21, 31]] });
    expect(data.driven.value).toEqual([
      { at: 1, place: [10, 20, 30], error: 0.5 },
      { at: 2, place: [11, 21, 31], error: 0 },
    ]);
    expect(program.asked('path').map((one) => one.since)).toEqual([-1, -1, 1]);
  });

  test('forgets its oldest points beyond 6000', async () => {
    const { data, program } = await following();
    await next(program, { driven: Array.from({ length: 6001 }, (_, i) => [i, 0, 0, 0]) });
    expect([data.driven.value.length, data.driven.value[0]?.at]).toEqual([6000, 1]);
  });

  test('stays cleared', async () => {
    const { data, program } = await following();
    await next(program, { driven: [[1, 0, 0, 0]] });
    program.show({ at: 7, state: 'hold' });
    data.clearDriven();
    expect(data.driven.value).toEqual([]);
    await next(program, {});
    expect(program.asked('path').at(-1)).toMatchObject({ since: 7 });
  });

  test('begins again after a restart of the program', async () => {
    const { data, program } = await following();
    await next(program, { number: 4, driven: [[1, 0, 0, 0]] });
    program.greet({ boot: 'second' });
    expect(data.driven.value).toEqual([]);
    await next(program, {});
    expect(program.asked('path').at(-1)).toMatchObject({ have: 0, since: -1 });
  });

  test('has a maximum error, at least a micrometre', async () => {
    const { data, program } = await following();
    expect(data.maxError.value).toBe(0.001);
    await next(program, {
      driven: [
        [1, 0, 0, 0],
        [2, 0, 0, 0],
      ],
      errors: [0.02, 0.3],
    });
    expect(data.maxError.value).toBe(0.3);
  });
});

describe('following the path', () => {
  test('sends five queries per second', async () => {
    const { program } = await following();
    for (let i = 0; i < 5; ++i) {
      program.show();
      await after(200);
    }
    expect(program.asked('path')).toHaveLength(6);
  });

  test('sends no query while the page is hidden or disconnected, and continues afterwards', async () => {
    const { browser, program } = await following();
    browser.hide(true);
    await after(1000);
    expect(program.asked('path')).toHaveLength(1);
    browser.hide(false);
    program.show();
    await after(200);
    expect(program.asked('path')).toHaveLength(2);
  });

  test('continues after a rejected query', async () => {
    const { program } = await following();
    program.answers.path = 'not now';
    await after(400);
    expect(program.asked('path')).toHaveLength(3);
  });

  test('ends when the view is closed', async () => {
    const { data, program, stop } = await following();
    stop();
    await after(1000);
    expect(program.asked('path')).toHaveLength(1);
    const { checked } = await import('../../src/path/checked');
    checked.value = { ok: true, problems: [], lines: 2, axes: 'X', path: [[1], [2]] };
    expect(data.planned.value).toEqual([]);
  });
});
