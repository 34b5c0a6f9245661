// Words of the calibration command of an IOFLEX02.
import { expect, test } from 'vitest';
import { wordOfAll, wordOfOne } from '../../src/cards/calibration';

test('a command for one axis leaves the others as they are', () => {
  expect(wordOfOne(0, 1)).toBe(0xe01);
  expect(wordOfOne(3, 2)).toBe(0x780);
});

test('four commands are one word with one for each axis', () => {
  expect(wordOfAll([0, 1, 2, 3])).toBe(0xe4);
  expect(wordOfAll([0, 0, 0, 0])).toBe(0);
});
