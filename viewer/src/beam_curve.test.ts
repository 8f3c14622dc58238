import { describe, expect, it } from 'vitest';
import { BeamCurve, cross, dot, perpendicular } from './beam_curve';
import type { Triple } from './page_data';

const kXi = [0, 0.1, 0.35, 0.5, 0.8, 1];

/** Tip-loaded cantilever of unit length: w = x²(3 − x)/2, a cubic: one element represents it exactly. */
const bent = [0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1.5];

describe('BeamCurve', () => {
  it('reproduces a cubic deflection exactly', () => {
    const curve = new BeamCurve([0, 0, 0], [1, 0, 0], true);
    curve.deform(bent, 0, 6, 0.1);
    for (const x of kXi) {
      curve.at(x);
      expect(curve.point[0]).toBeCloseTo(x, 14);
      expect(curve.point[1]).toBeCloseTo((0.1 * x * x * (3 - x)) / 2, 14);
      expect(curve.tangent[1]).toBeCloseTo((0.1 * (6 * x - 3 * x * x)) / 2, 14);
    }
  });

  it('bends about any axis with the sign of θ × e', () => {
    // Along z, θ about x at both ends and w = −θ z: a small rigid rotation, a straight line.
    const theta = 0.01;
    const curve = new BeamCurve([0, 0, 0], [0, 0, 2], true);
    curve.deform([0, 0, 0, theta, 0, 0, 0, -2 * theta, 0, theta, 0, 0], 0, 6, 1);
    for (const xi of kXi) {
      curve.at(xi);
      expect(curve.point[1]).toBeCloseTo(-theta * 2 * xi, 14);
      expect(curve.point[2]).toBeCloseTo(2 * xi, 14);
    }
  });

  it('stretches linearly along the axis', () => {
    const curve = new BeamCurve([1, 0, 0], [3, 0, 0], true);
    curve.deform([0, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0], 0, 6, 2);
    for (const xi of kXi) {
      curve.at(xi);
      expect(curve.point[0]).toBeCloseTo(1 + 3 * xi, 14);
      expect(curve.tangent[0]).toBeCloseTo(3, 13);
    }
  });

  it('keeps bars straight', () => {
    const curve = new BeamCurve([0, 0, 0], [1, 0, 0], false);
    curve.deform([0, 0, 0, 0, 0, 0, 0, 0.4, 0, 0, 0, 0], 0, 6, 1);
    for (const xi of kXi) {
      curve.at(xi);
      expect(curve.point[1]).toBeCloseTo(0.4 * xi, 14);
    }
  });
});

describe('vectors', () => {
  it('finds a unit vector at right angles to any axis', () => {
    const axes: Triple[] = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
      [0.6, 0, 0.8],
      [0.36, 0.48, 0.8],
    ];
    for (const e of axes) {
      const n = perpendicular(e);
      expect(dot(n, e)).toBeCloseTo(0, 14);
      expect(Math.hypot(...n)).toBeCloseTo(1, 14);
      expect(Math.hypot(...cross(n, e))).toBeCloseTo(1, 14);
    }
  });
});
