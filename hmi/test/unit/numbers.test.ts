// Display and parsing of numbers.
import { expect, test } from 'vitest';
import { duration, fixed, hex, percent, position, seconds, typed, unitName, whole } from '../../src/parts/numbers';

const THIN = '\u2009';

test('a number has the requested decimals', () => {
  expect(fixed(1.23456, 3)).toBe('1.235');
  expect(fixed(7, 2)).toBe('7.00');
  expect(fixed(0.5, 0)).toBe('1');
});

test('a negative number has a true minus sign, as wide as a digit', () => expect(fixed(-2.5, 1)).toBe('−2.5'));

test('a number that rounds to zero has no sign', () => {
  expect(fixed(-0.0004, 3)).toBe('0.000');
  expect(fixed(-0, 1)).toBe('0.0');
});

test.each([null, undefined, NaN, Infinity, -Infinity])('a missing number (%s) is shown as a dash', (none) => {
  expect(fixed(none, 3)).toBe('–');
  expect(whole(none)).toBe('–');
  expect(hex(none, 8)).toBe('–');
  expect(duration(none)).toBe('–');
});

test('positions have four decimals in mm and degrees, five in inches, four in any other unit', () => {
  expect(position(1.23456789, 'mm')).toBe('1.2346');
  expect(position(1.23456789, 'deg')).toBe('1.2346');
  expect(position(1.23456789, 'inch')).toBe('1.23457');
  expect(position(1.23456789, 'pulses')).toBe('1.2346');
});

test('whole numbers have a thin blank every three digits', () => {
  expect(whole(999)).toBe('999');
  expect(whole(1000)).toBe(`1${THIN}000`);
  expect(whole(-12345678)).toBe(`−12${THIN}345${THIN}678`);
  expect(whole(1.6)).toBe('2');
});

test('words are shown in as many hexadecimal digits as their bits need', () => {
  expect(hex(255, 8)).toBe('FFh');
  expect(hex(10, 16)).toBe('000Ah');
  expect(hex(5, 3)).toBe('5h');
  expect(hex(0x1ff, 9)).toBe('1FFh');
});

test('a negative word is shown as its two’s complement, a too large one by its low bits', () => {
  expect(hex(-1, 16)).toBe('FFFFh');
  expect(hex(-2, 32)).toBe('FFFFFFFEh');
  expect(hex(0x12345, 16)).toBe('2345h');
});

test('a part is shown in whole per cent', () => {
  expect(percent(0.05)).toBe('5 %');
  expect(percent(1.204)).toBe('120 %');
  expect(percent(0)).toBe('0 %');
});

test('a duration is shown in minutes and tenths of a second, from an hour on without tenths', () => {
  expect(duration(0)).toBe('0:00.0');
  expect(duration(12.34)).toBe('0:12.3');
  expect(duration(75.2)).toBe('1:15.2');
  expect(duration(3723.9)).toBe('1:02:03');
});

test('a duration that rounds up to a minute or an hour carries over', () => {
  expect(duration(59.96)).toBe('1:00.0');
  expect(duration(3599.97)).toBe('1:00:00');
});

test('a duration is never below zero', () => expect(duration(-3)).toBe('0:00.0'));

test('a time of the machine is shown with milliseconds', () => expect(seconds(12.3456)).toBe('12.346 s'));

test('degrees have their sign; other units are written as they are called', () => {
  expect(unitName('deg')).toBe('°');
  expect(unitName('mm')).toBe('mm');
});

test.each([
  ['12.5', 12.5],
  [' 7 ', 7],
  ['-3', -3],
  ['−3', -3],
  ['0,25', 0.25],
  ['1e3', 1000],
  ['.5', 0.5],
])('"%s" is read as %d', (text, value) => expect(typed(text)).toBe(value));

test.each(['', '  ', 'X', '1 2', '1.2.3', '1,000,000', 'Infinity', '--1'])('"%s" is not a number', (text) =>
  expect(typed(text)).toBeNull(),
);
