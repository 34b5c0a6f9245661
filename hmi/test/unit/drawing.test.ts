// Drawings of paths and workpieces: colours, displayed part, viewpoint.
import { describe, expect, test } from 'vitest';
import { pathOf, sight, strokesOf, type PieceAnswer } from '../../src/cards/piece';
import { css, errorColour } from '../../src/path/colours';
import { KEY_TURNS, turned } from '../../src/path/eye';
import { boxAround, MARGIN, niceStep, planesOf, sightOf, travelBox } from '../../src/path/sight';

describe('colours of errors', () => {
  test.each([true, false])('go from blue to red (dark: %s)', (dark) => {
    const [none, most] = [errorColour(0, dark), errorColour(1, dark)];
    expect(none[2]).toBeGreaterThan(none[0]);
    expect(most[0]).toBeGreaterThan(most[2]);
  });

  test('lie between their neighbours', () => {
    const [low, middle, high] = [0, 0.125, 0.25].map((part) => errorColour(part, true));
    expect(middle).toEqual([0, 1, 2].map((i) => Math.round(((low?.[i] ?? 0) + (high?.[i] ?? 0)) / 2)));
  });

  test('stay at their ends for an error outside of the scale', () => {
    expect(errorColour(-3, true)).toEqual(errorColour(0, true));
    expect(errorColour(7, false)).toEqual(errorColour(1, false));
  });

  test('are written for CSS', () => expect(css([1, 20, 255])).toBe('rgb(1,20,255)'));
});

describe('the grid', () => {
  test.each([
    [0.7, 1],
    [1, 1],
    [1.1, 2],
    [3, 5],
    [5.5, 10],
    [12, 20],
    [0.03, 0.05],
  ])('has lines %d apart at min, at %d', (min, step) => expect(niceStep(min)).toBeCloseTo(step, 12));
});

describe('the flat view', () => {
  test('covers the whole travel', () => {
    expect(travelBox({ min: -10, max: 50 }, { min: 0, max: 20 })).toEqual([-10, 50, 0, 20]);
  });

  test('uses 0 to 1 for an axis that the machine does not have', () => {
    expect(travelBox({ min: -10, max: 50 }, undefined)).toEqual([-10, 50, 0, 1]);
  });

  test('has a margin of a twentieth around points, at least one unit', () => {
    const points = [
      [0, 5, 0],
      [60, 5, 40],
      [30, 5, 20],
    ];
    expect(boxAround(points, 0, 2)).toEqual([-5, 65, -5, 45]);
    expect(boxAround([[3], [3]], 0, 0)).toEqual([2, 4, 2, 4]);
  });

  test('does not exist around fewer than two points', () => expect(boxAround([[1, 2]], 0, 1)).toBeNull());

  test('is centred, as large as fits, and not distorted', () => {
    const [width, height] = [400, 300];
    const { scale, left, top } = sightOf([10, 110, -20, 30], width, height);
    expect(scale).toBeCloseTo((width - 2 * MARGIN) / 100, 12);
    expect(left + 60 * scale).toBeCloseTo(width / 2, 9);
    expect(top - 5 * scale).toBeCloseTo(height / 2, 9);
  });

  test('is limited by the height of a tall box', () => {
    expect(sightOf([0, 1, 0, 100], 400, 300).scale).toBeCloseTo((300 - 2 * MARGIN) / 100, 12);
  });

  test('is finite for a single point', () => expect(Number.isFinite(sightOf([5, 5, 5, 5], 400, 300).left)).toBe(true));
});

describe('the planes', () => {
  test('are those whose axes the machine has', () => {
    expect(planesOf('XYZA', 'XZ')).toEqual({ options: ['XY', 'XZ', 'YZ', '3D'], shown: 'XZ' });
    expect(planesOf('XZ', 'XZ')).toEqual({ options: ['XZ'], shown: 'XZ' });
  });

  test('show another one if the chosen one does not exist', () => {
    expect(planesOf('YZA', 'XY')).toEqual({ options: ['YZ', '3D'], shown: 'YZ' });
  });

  test('are the first two axes if the machine has no two of X, Y and Z', () => {
    expect(planesOf('AB', 'XY')).toEqual({ options: ['AB'], shown: 'AB' });
    expect(planesOf('', 'XY').shown).toBe('');
  });

  test('keep the 3D view if it was chosen', () => expect(planesOf('XYZ', '3D').shown).toBe('3D'));
});

describe('the camera', () => {
  const eye = { turn: 0.5, tilt: 0, far: 100 };

  test('rotates, tilts and zooms by fixed steps', () => {
    expect(turned(eye, { turn: 0.25, tilt: -0.5 })).toEqual({ turn: 0.75, tilt: -0.5, far: 100 });
    expect(turned(eye, { far: 0.5 }).far).toBe(50);
  });

  test('stops at the poles', () => {
    expect(turned(eye, { tilt: 9 }).tilt).toBe(1.5);
    expect(turned(eye, { tilt: -9 }).tilt).toBe(-1.5);
  });

  test('limits the zoom to 1 to 10000', () => {
    expect(turned(eye, { far: 1e-6 }).far).toBe(1);
    expect(turned(eye, { far: 1e6 }).far).toBe(1e4);
  });

  test('returns by the opposite arrow', () => {
    const there = turned(eye, KEY_TURNS.ArrowLeft ?? {});
    expect(there.turn).not.toBe(eye.turn);
    expect(turned(there, KEY_TURNS.ArrowRight ?? {}).turn).toBeCloseTo(eye.turn, 12);
  });

  test('zooms in by plus and out by minus', () => {
    expect(turned(eye, KEY_TURNS['+'] ?? {}).far).toBeLessThan(eye.far);
    expect(turned(eye, KEY_TURNS['-'] ?? {}).far).toBeGreaterThan(eye.far);
  });
});

describe('a workpiece', () => {
  const piece: PieceAnswer = {
    scanner: 'head',
    marks: [],
    points: 0,
    lost_points: 0,
    marked_mm: 0,
    beam: [0, 0],
    laser: false,
    field: { min: [-50, -40], max: [50, 40] },
  };
  const marked: PieceAnswer = {
    ...piece,
    marks: [
      [
        [0, 0],
        [10, 5],
      ],
    ],
  };

  test('shows the field if it has no marks', () => expect(sight(piece)).toEqual([-54, -44, 108, 88]));

  test('shows its marks with Y upwards', () => expect(sight(marked)).toEqual([-1, -6, 12, 7]));

  test('includes the stroke that is being marked', () => {
    expect(strokesOf(piece)).toEqual([]);
    expect(
      strokesOf({
        ...marked,
        marking: [
          [10, 5],
          [12, 5],
        ],
      }),
    ).toHaveLength(2);
  });

  test('is drawn stroke by stroke', () => {
    expect(
      pathOf([
        [
          [0, 1],
          [10, 5],
        ],
        [
          [2, 2],
          [3, -3],
        ],
      ]),
    ).toBe('M0 -1L10 -5M2 -2L3 3');
    expect(pathOf([])).toBe('');
  });
});
