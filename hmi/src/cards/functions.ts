// Functions of a card's library from their declaration: groups, typed texts, calls and answers.
import { typed, whole } from '../parts/numbers';

export interface ArgumentInfo {
  name: string;
  min: number;
  max: number;
  unit: string;
  meaning: string;
  /** Initial value of the form. */
  start: number;
  /** The only valid values; empty: the whole range. */
  values: { value: number; meaning: string }[];
  /** Any sum of `values` is valid. */
  sum: boolean;
}
export interface FunctionInfo {
  name: string;
  group: string;
  meaning: string;
  arguments: ArgumentInfo[];
  /** Description of the returned number with its unit; empty: none. */
  returns: string;
  waits: boolean;
  own: boolean;
}
export interface Group {
  name: string;
  functions: FunctionInfo[];
}

/** Functions that match every word of the search, in their groups and order. */
export function groupsOf(functions: readonly FunctionInfo[], search: string): Group[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const groups: Group[] = [];
  for (const one of functions) {
    const text = `${one.name} ${one.group} ${one.meaning}`.toLowerCase();
    if (!words.every((word) => text.includes(word))) continue;
    const last = groups[groups.length - 1];
    if (last?.name === one.group) last.functions.push(one);
    else groups.push({ name: one.group, functions: [one] });
  }
  return groups;
}

export function rangeText(argument: ArgumentInfo): string {
  if (argument.values.length > 0)
    return argument.values.map((one) => `${one.value} ${one.meaning}`).join(', ') + (argument.sum ? ', or a sum' : '');
  return `${whole(argument.min)} to ${whole(argument.max)}${argument.unit === '' ? '' : ` ${argument.unit}`}`;
}

export type Texts = Record<string, string>;

export const startsOf = (one: FunctionInfo): Texts =>
  Object.fromEntries(one.arguments.map((argument) => [argument.name, String(argument.start)]));

/** Returns the fields to send, or the reason for a rejection. The program checks again and decides. */
export function readTexts(
  one: FunctionInfo,
  texts: Texts,
): { values: Record<string, number>; why?: never } | { why: string; values?: never } {
  const values: Record<string, number> = {};
  for (const argument of one.arguments) {
    const text = texts[argument.name] ?? '';
    const value = typed(text);
    if (value === null || !Number.isInteger(value) || value < argument.min || value > argument.max)
      return {
        why: `${one.name}: ${argument.name} is "${text}", but must be ${rangeText(argument)}. Nothing was called.`,
      };
    values[argument.name] = value;
  }
  return { values };
}

/** Toggles one part of a sum. */
export const turned = (sum: number, part: number): number => ((sum & part) === part ? sum & ~part : sum | part);

/** "TCurve_F(axis 1, m_SV 100)". */
export const callText = (name: string, values: Record<string, number>): string =>
  `${name}(${Object.entries(values)
    .map(([argument, value]) => `${argument} ${value}`)
    .join(', ')})`;
