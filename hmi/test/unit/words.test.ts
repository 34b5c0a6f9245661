// Register words: their fields, and parsing of typed words.
import { expect, test } from 'vitest';
import type { RegisterInfo } from '../../src/link/rack';
import { analogOutputs, fieldValues, typedWord } from '../../src/cards/words';

const register = (...fields: [name: string, low: number, bits: number][]): RegisterInfo => ({
  name: 'RR0',
  offset: 0,
  width: 32,
  access: 'r',
  meaning: 'main status',
  fields: fields.map(([name, low, bits]) => ({ name, low, bits, meaning: name })),
});

test('the fields of a word are listed with their bits, highest first', () => {
  const values = fieldValues(register(['X_DRV', 0, 1], ['MODE', 4, 4], ['BUSY', 15, 1]), 0x8095);
  expect(values.map(({ field, bits, value }) => [field.name, bits, value])).toEqual([
    ['BUSY', '15', 1],
    ['MODE', '7:4', 9],
    ['X_DRV', '0', 1],
  ]);
});

test('a field in the highest bits of a word of 32 is not negative', () => {
  expect(fieldValues(register(['TOP', 28, 4], ['ALL', 0, 32]), 0xf0000001).map((one) => one.value)).toEqual([
    15, 0xf0000001,
  ]);
});

test('reading fields leaves the order of the table as it is', () => {
  const table = register(['LOW', 0, 1], ['HIGH', 7, 1]);
  fieldValues(table, 0);
  expect(table.fields.map((one) => one.name)).toEqual(['LOW', 'HIGH']);
});

test('a register without fields has none', () => expect(fieldValues(register(), 5)).toEqual([]));

test.each([
  ['31', 31],
  [' 31 ', 31],
  ['0x1F', 31],
  ['0X1f', 31],
  ['1Fh', 31],
  ['0FFH', 255],
  ["'G'", 71],
  ['0', 0],
])('%s is read as the word %d', (text, word) => expect(typedWord(text, 8)).toBe(word));

test.each(['', 'G', '1F', '-1', '1.5', '0x', 'h', "''", "'AB'", '12 34'])('"%s" is not a word', (text) =>
  expect(typedWord(text, 16)).toBeNull(),
);

test('a word of more bits than the register is refused', () => {
  expect(typedWord('255', 8)).toBe(255);
  expect(typedWord('256', 8)).toBeNull();
  expect(typedWord('FFFFFFFFh', 32)).toBe(0xffffffff);
  expect(typedWord('100000000h', 32)).toBeNull();
  expect(typedWord("'€'", 8)).toBeNull();
});

test('both analog outputs are shown, the one behind the relay and the direct one', () => {
  expect(analogOutputs({ vout: 0, vdirect: -9.5 })).toBe('0.0000 V behind the relay, −9.5000 V direct');
  expect(analogOutputs(undefined)).toBe('– V behind the relay, – V direct');
});
