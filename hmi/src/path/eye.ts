// Viewpoint of the path in space: rotated around the centre of the machine, at a distance.

/** Angles in radians, distance in the unit of the axes. */
export interface Eye {
  turn: number;
  tilt: number;
  far: number;
}

/** Relative change; distance as a factor. */
export interface Turn {
  turn?: number;
  tilt?: number;
  far?: number;
}

/** Maximum tilt, rad: below pi/2, because up and down would swap beyond the poles. */
const MAX_TILT = 1.5;
const [NEAREST, FARTHEST] = [1, 1e4];

const within = (value: number, min: number, max: number): number => Math.min(max, Math.max(min, value));

export const turned = (eye: Eye, by: Turn): Eye => ({
  turn: eye.turn + (by.turn ?? 0),
  tilt: within(eye.tilt + (by.tilt ?? 0), -MAX_TILT, MAX_TILT),
  far: within(eye.far * (by.far ?? 1), NEAREST, FARTHEST),
});

/** Rotations by KeyboardEvent.key. */
export const KEY_TURNS: Partial<Record<string, Turn>> = {
  ArrowLeft: { turn: -0.1 },
  ArrowRight: { turn: 0.1 },
  ArrowUp: { tilt: 0.1 },
  ArrowDown: { tilt: -0.1 },
  '+': { far: 0.9 },
  '-': { far: 1.1 },
};
