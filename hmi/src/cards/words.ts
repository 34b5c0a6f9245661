// A register's word as its fields: which bits, which value.
import type { FieldInfo, RegisterInfo } from '../link/rack';

export interface FieldValue {
  field: FieldInfo;
  /** "3", "15:8". */
  bits: string;
  value: number;
}

/** Highest bits first. */
export function fieldValues(register: RegisterInfo, word: number): FieldValue[] {
  return register.fields
    .map((field) => ({
      field,
      bits: field.bits === 1 ? `${field.low}` : `${field.low + field.bits - 1}:${field.low}`,
      value: Math.floor(word / 2 ** field.low) % 2 ** field.bits,
    }))
    .sort((a, b) => b.field.low - a.field.low);
}
