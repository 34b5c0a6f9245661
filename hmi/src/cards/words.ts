// Register words as fields and as typed text.
import type { FieldInfo, RegisterInfo } from '../link/rack';
import { fixed } from '../parts/numbers';

export interface FieldValue {
  field: FieldInfo;
  /** "3", "15:8". */
  bits: string;
  value: number;
}

/** Most significant bits first. */
export function fieldValues(register: RegisterInfo, word: number): FieldValue[] {
  return register.fields
    .map((field) => ({
      field,
      bits: field.bits === 1 ? `${field.low}` : `${field.low + field.bits - 1}:${field.low}`,
      value: Math.floor(word / 2 ** field.low) % 2 ** field.bits,
    }))
    .sort((a, b) => b.field.low - a.field.low);
}

/** Parses "1Fh", "0x1F", "31", "'G'" as a word of this many bits; null if invalid. */
export function typedWord(text: string, bits: number): number | null {
  const plain = text.trim();
  const letter = /^'(.)'$/.exec(plain)?.[1];
  let word = NaN;
  if (letter !== undefined) word = letter.charCodeAt(0);
  else if (/^[0-9a-f]+h$/i.test(plain)) word = parseInt(plain, 16);
  else if (/^(0x[0-9a-f]+|\d+)$/i.test(plain)) word = Number(plain);
  return word < 2 ** bits ? word : null;
}

/** Both analog outputs of a DataBoard 4002; EMS acts on the one behind the relay only. */
export const analogOutputs = (pins: Record<string, number> | undefined): string =>
  `${fixed(pins?.vout, 4)} V behind the relay, ${fixed(pins?.vdirect, 4)} V direct`;
