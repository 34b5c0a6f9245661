// Displayed part of the machine in a flat picture of the path, and its scale.

/** x0, x1, y0, y1 in the unit of the axes. */
export type Box = readonly [number, number, number, number];

/** A position is drawn at left + x scale, top - y scale. */
export interface Sight {
  scale: number;
  left: number;
  top: number;
}

interface Travel {
  min: number;
  max: number;
}

/** Margin around the picture, px. */
export const MARGIN = 34;

/** Smallest of 1, 2 or 5 times a power of ten that is not below `min`. */
export function niceStep(min: number): number {
  const power = 10 ** Math.floor(Math.log10(min));
  for (const factor of [1, 2, 5]) if (power * factor >= min) return power * factor;
  return power * 10;
}

/** Planes available with these axes, and the one to show for the selection `wanted`. */
export function planesOf(letters: string, wanted: string): { options: string[]; shown: string } {
  const planes = ['XY', 'XZ', 'YZ'].filter((one) => [...one].every((letter) => letters.includes(letter)));
  const flat = planes.length > 0 ? planes : [letters.slice(0, 2)];
  const shown = wanted === '3D' || planes.includes(wanted) ? wanted : (flat[0] ?? '');
  return { options: [...flat, ...(letters.length >= 3 ? ['3D'] : [])], shown };
}

/** The whole travel; a missing axis ranges from 0 to 1. */
export const travelBox = (x: Travel | undefined, y: Travel | undefined): Box => [
  x?.min ?? 0,
  x?.max ?? 1,
  y?.min ?? 0,
  y?.max ?? 1,
];

/** Bounds of points, by the indices `a` and `b` of two axes; null: too few points. */
export function boxAround(points: readonly (readonly number[])[], a: number, b: number): Box | null {
  if (points.length < 2) return null;
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const point of points) {
    const [x, y] = [point[a] ?? 0, point[b] ?? 0];
    [x0, x1] = [Math.min(x0, x), Math.max(x1, x)];
    [y0, y1] = [Math.min(y0, y), Math.max(y1, y)];
  }
  const pad = Math.max(1, (x1 - x0 + y1 - y0) * 0.05);
  return [x0 - pad, x1 + pad, y0 - pad, y1 + pad];
}

/** Centres the box on a canvas of this size in px, as large as possible. */
export function sightOf([x0, x1, y0, y1]: Box, width: number, height: number): Sight {
  const scale = Math.min(
    (width - 2 * MARGIN) / Math.max(1e-9, x1 - x0),
    (height - 2 * MARGIN) / Math.max(1e-9, y1 - y0),
  );
  return { scale, left: width / 2 - ((x0 + x1) / 2) * scale, top: height / 2 + ((y0 + y1) / 2) * scale };
}
