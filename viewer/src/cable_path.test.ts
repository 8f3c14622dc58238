import { describe, expect, it } from 'vitest';
import { cablePath } from './cable_path';
import type { Triple } from './page_data';

const kAxis: Triple = [0, 0, 1];

function length(path: Triple[]): number {
  return path.slice(1).reduce((sum, p, i) => sum + Math.hypot(...p.map((x, k) => x - path[i]![k]!)), 0);
}

describe('cablePath', () => {
  it('runs around two equal pulleys as an open belt', () => {
    const path = cablePath([{ centre: [0, 0, 0], radius: 0.1 }, { centre: [1, 0, 0], radius: 0.1 }], true, kAxis);
    // Chords of 7.5 degrees are 7e-4 shorter than arcs.
    expect(length(path)).toBeCloseTo(2 + 0.2 * Math.PI, 3);
    expect(Math.min(...path.map((p) => p[1]))).toBeCloseTo(-0.1, 9);
    expect(path[0]).toEqual(path.at(-1));
  });

  it('crosses between pulleys that turn against each other', () => {
    const path = cablePath([{ centre: [0, 0, 0], radius: 0.1 }, { centre: [1, 0, 0], radius: -0.1 }], true, kAxis);
    const half = Math.asin(0.2);
    expect(length(path)).toBeCloseTo(2 * Math.sqrt(1 - 0.04) + 0.2 * (Math.PI + 2 * half), 3);
  });

  it('hangs over a pulley between its ends', () => {
    const path = cablePath(
      [{ centre: [-0.1, -1, 0], radius: 0 }, { centre: [0, 0, 0], radius: -0.1 }, { centre: [0.1, -2, 0], radius: 0 }],
      false,
      kAxis,
    );
    expect(length(path)).toBeCloseTo(3 + 0.1 * Math.PI, 3);
    expect(Math.max(...path.map((p) => p[1]))).toBeCloseTo(0.1, 4);
  });

  it('goes around a drum at its end once more', () => {
    const path = cablePath([{ centre: [0, 0, 0], radius: 0.1 }, { centre: [1, 0.1, 0], radius: 0 }], false, kAxis);
    expect(length(path)).toBeCloseTo(0.2 * Math.PI + Math.sqrt(1.01 - 0.01), 2);
  });

  it('draws straight where a span cannot be formed', () => {
    const path = cablePath([{ centre: [0, 0, 0], radius: 0.4 }, { centre: [0.1, 0, 0], radius: -0.4 }], true, kAxis);
    expect(path.every((p) => p.every(Number.isFinite))).toBe(true);
  });
});
