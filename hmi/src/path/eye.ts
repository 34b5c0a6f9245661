// The place from which the path in space is looked at: turned around the middle of the machine, nearer or farther.

/** Angles in radians, the distance in the unit of the axes. */
export interface Eye {
  turn: number;
  tilt: number;
  far: number;
}

/** By so much; the distance by a factor. */
export interface Turn {
  turn?: number;
  tilt?: number;
  far?: number;
}

/** Not over the poles, where up and down would change places. */
const MAX_TILT = 1.5;
const [NEAREST, FARTHEST] = [1, 1e4];

const within = (value: number, least: number, greatest: number): number => Math.min(greatest, Math.max(least, value));

export const turned = (eye: Eye, by: Turn): Eye => ({
  turn: eye.turn + (by.turn ?? 0),
  tilt: within(eye.tilt + (by.tilt ?? 0), -MAX_TILT, MAX_TILT),
  far: within(eye.far * (by.far ?? 1), NEAREST, FARTHEST),
});

/** Turns of the keys, by KeyboardEvent.key. */
export const KEY_TURNS: Partial<Record<string, Turn>> = {
  ArrowLeft: { turn: -0.1 },
  ArrowRight: { turn: 0.1 },
  ArrowUp: { tilt: 0.1 },
  ArrowDown: { tilt: -0.1 },
  '+': { far: 0.9 },
  '-': { far: 1.1 },
};
