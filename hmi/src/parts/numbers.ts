// Numbers as text of constant width, so that digits do not jump.

const MINUS = '\u2212';

/** Fixed decimals with a true minus sign; a dash for a missing number. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

export const DECIMALS: Record<string, number> = { mm: 4, deg: 4, inch: 5 };
export const position = (value: number | null | undefined, unit: string): string => fixed(value, DECIMALS[unit] ?? 4);

export function whole(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = Math.abs(Math.round(value))
    .toString()
    .replace(/\B(?=(\d{3})+$)/g, '\u2009');
  return value < 0 ? MINUS + text : text;
}

export function hex(value: number | null | undefined, bits: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const digits = Math.max(1, Math.ceil(bits / 4));
  const span = 2 ** bits;
  const unsigned = ((value % span) + span) % span;
  return `${unsigned.toString(16).toUpperCase().padStart(digits, '0')}h`;
}

export const percent = (part: number): string => `${Math.round(part * 100)} %`;

/** "0:12.3", "1:02:03". */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–';
  const all = Math.round(Math.max(0, seconds) * 10) / 10;
  const hours = Math.floor(all / 3600);
  const minutes = Math.floor(all / 60) % 60;
  const rest = all % 60;
  if (hours > 0) return `${hours}:${String(minutes).padStart(2, '0')}:${String(Math.floor(rest)).padStart(2, '0')}`;
  return `${minutes}:${rest.toFixed(1).padStart(4, '0')}`;
}

export const seconds = (at: number): string => `${fixed(at, 3)} s`;
export const unitName = (unit: string): string => (unit === 'deg' ? '°' : unit);

/** Parses a typed number; null if invalid. Accepts a comma as decimal point. */
export function typed(text: string): number | null {
  const value = Number(text.trim().replace(',', '.').replace(MINUS, '-'));
  return text.trim() === '' || !Number.isFinite(value) ? null : value;
}
