// Functions of a card's library, for any declaration: groups, search, typed arguments, calls.
import { expect, test } from 'vitest';
import {
  callText,
  groupsOf,
  rangeText,
  readTexts,
  startsOf,
  turned,
  type ArgumentInfo,
  type FunctionInfo,
} from '../../src/cards/functions';

const argument = (name: string, part: Partial<ArgumentInfo> = {}): ArgumentInfo => ({
  name,
  min: 1,
  max: 8000,
  unit: 'x M pulses/s',
  meaning: 'speed',
  start: 1000,
  values: [],
  sum: false,
  ...part,
});
const axes = argument('axis', {
  min: 1,
  max: 3,
  start: 1,
  sum: true,
  values: [
    { value: 1, meaning: 'X' },
    { value: 2, meaning: 'Y' },
  ],
});
const made = (name: string, group: string, meaning: string, ...all: ArgumentInfo[]): FunctionInfo => ({
  name,
  group,
  meaning,
  arguments: all,
  returns: '',
  waits: false,
  own: false,
});
const functions = [
  made('SetV', 'Basic', 'Drive speed.', axes, argument('data')),
  made('SetA', 'Basic', 'Acceleration.', axes),
  made('RESET', 'Positions', 'Resets the chip.'),
];

const found = (search: string): [string, string[]][] =>
  groupsOf(functions, search).map((group) => [group.name, group.functions.map((one) => one.name)]);

test('functions are grouped as they are declared', () => {
  expect(found('')).toEqual([
    ['Basic', ['SetV', 'SetA']],
    ['Positions', ['RESET']],
  ]);
});

test('a search takes names, groups and words, all of them at once, in any case', () => {
  expect(found('setv')).toEqual([['Basic', ['SetV']]]);
  expect(found(' SPEED basic ')).toEqual([['Basic', ['SetV']]]);
  expect(found('positions')).toEqual([['Positions', ['RESET']]]);
  expect(found('speed chip')).toEqual([]);
});

test('a form begins with the declared values, and sends whole numbers', () => {
  const [setV] = functions;
  if (setV === undefined) throw new Error('there is none');
  expect(startsOf(setV)).toEqual({ axis: '1', data: '1000' });
  expect(readTexts(setV, { axis: '3', data: ' 2000 ' })).toEqual({ values: { axis: 3, data: 2000 } });
});

test('a value out of range is not sent, and the range is reported', () => {
  const [setV] = functions;
  if (setV === undefined) throw new Error('there is none');
  for (const data of ['0', '8001', '1.5', 'x', ''])
    expect(readTexts(setV, { axis: '1', data }).why).toBe(
      `SetV: data is "${data}", but must be 1 to 8\u2009000 x M pulses/s. Nothing was called.`,
    );
  expect(readTexts(setV, { axis: '0', data: '1' }).why).toContain('1 X, 2 Y, or a sum');
});

test('ranges have their units or their values', () => {
  expect(rangeText(argument('data', { unit: '' }))).toBe('1 to 8\u2009000');
  expect(rangeText({ ...axes, sum: false })).toBe('1 X, 2 Y');
});

test('parts of a sum are added and removed', () => {
  expect(turned(1, 2)).toBe(3);
  expect(turned(3, 1)).toBe(2);
});

test('a call is written with its arguments', () => {
  expect(callText('SetV', { axis: 3, data: 20 })).toBe('SetV(axis 3, data 20)');
  expect(callText('RESET', {})).toBe('RESET()');
});
