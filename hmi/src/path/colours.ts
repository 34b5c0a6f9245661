// Error colours from blue over grey to amber and red, with lightness for the dark theme; never green against red.

const DARK: readonly (readonly [number, number, number])[] = [
  [72, 166, 236],
  [130, 196, 240],
  [226, 214, 170],
  [246, 176, 72],
  [240, 96, 66],
];
const LIGHT: readonly (readonly [number, number, number])[] = [
  [10, 96, 168],
  [60, 130, 180],
  [130, 120, 70],
  [176, 100, 0],
  [180, 30, 20],
];

/** `part` 0 .. 1. */
export function errorColour(part: number, dark: boolean): [number, number, number] {
  const map = dark ? DARK : LIGHT;
  const at = Math.min(1, Math.max(0, part)) * (map.length - 1);
  const low = Math.min(map.length - 2, Math.floor(at));
  const a = map[low] ?? [0, 0, 0];
  const b = map[low + 1] ?? a;
  const mix = (i: 0 | 1 | 2): number => Math.round(a[i] + (b[i] - a[i]) * (at - low));
  return [mix(0), mix(1), mix(2)];
}

export const css = ([r, g, b]: [number, number, number]): string => `rgb(${r},${g},${b})`;
export const STEPS_SHOWN = 24;
