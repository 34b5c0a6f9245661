// A register's word as its fields: which bits, which value.
import type { FieldInfo, RegisterInfo } from '../link/rack';

export interface FieldValue {
  field: FieldInfo;
  bits: string;
  width: number;
  value: number;
}

const lowest = (mask: number): number => 31 - Math.clz32(mask & -mask);
const highest = (mask: number): number => 31 - Math.clz32(mask >>> 0);

export function fieldValues(register: RegisterInfo, word: number): FieldValue[] {
  return register.fields
    .map((field) => {
      const low = lowest(field.mask);
      const high = highest(field.mask);
      const width = high - low + 1;
      const value = ((word >>> low) & (width >= 32 ? 0xffffffff : (1 << width) - 1)) >>> 0;
      return { field, bits: high === low ? `${low}` : `${high}:${low}`, width, value };
    })
    .sort((a, b) => lowest(b.field.mask) - lowest(a.field.mask));
}

/** "x.RR1" -> "RR1". */
export const plainName = (name: string): string => name.slice(name.lastIndexOf('.') + 1);
