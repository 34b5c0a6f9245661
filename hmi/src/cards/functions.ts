// The functions of a card's library as their declaration has them: groups, what was typed, what is sent and answered.
import { typed, whole } from '../parts/numbers';

export interface ArgumentInfo {
  name: string;
  least: number;
  greatest: number;
  unit: string;
  meaning: string;
  /** What a form begins with. */
  start: number;
  /** The only values that there are; none: all of the range. */
  values: { value: number; meaning: string }[];
  /** Any sum of `values`. */
  sum: boolean;
}
export interface FunctionInfo {
  name: string;
  group: string;
  meaning: string;
  arguments: ArgumentInfo[];
  /** The returned number, with its unit; empty: none. */
  returns: string;
  waits: boolean;
  own: boolean;
}
export interface Group {
  name: string;
  functions: FunctionInfo[];
}

/** Those in which every word of the search is found, in their groups and in their order. */
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
  return `${whole(argument.least)} to ${whole(argument.greatest)}${argument.unit === '' ? '' : ` ${argument.unit}`}`;
}

export type Texts = Record<string, string>;

export const startsOf = (one: FunctionInfo): Texts =>
  Object.fromEntries(one.arguments.map((argument) => [argument.name, String(argument.start)]));

/** What is sent, or why not. The program checks again, and has the last word. */
export function readTexts(
  one: FunctionInfo,
  texts: Texts,
): { values: Record<string, number>; why?: never } | { why: string; values?: never } {
  const values: Record<string, number> = {};
  for (const argument of one.arguments) {
    const text = texts[argument.name] ?? '';
    const value = typed(text);
    if (value === null || !Number.isInteger(value) || value < argument.least || value > argument.greatest)
      return {
        why: `${one.name}: ${argument.name} is "${text}", but must be ${rangeText(argument)}. Nothing was called.`,
      };
    values[argument.name] = value;
  }
  return { values };
}

/** A sum with one of its parts put in or taken out. */
export const turned = (sum: number, part: number): number => ((sum & part) === part ? sum & ~part : sum | part);

/** "TCurve_F(axis 1, m_SV 100)". */
export const callText = (name: string, values: Record<string, number>): string =>
  `${name}(${Object.entries(values)
    .map(([argument, value]) => `${argument} ${value}`)
    .join(', ')})`;
