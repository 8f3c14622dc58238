import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { aligned } from './chart';
import { Magnitudes } from './magnitudes';
import { decodeRun } from './run';

describe('Magnitudes', () => {
  const run = decodeRun(kVariants['slider-crank']());
  const magnitudes = new Magnitudes([run], 0.6);

  it('tell what rounding left of zero from small values', () => {
    // 1e-29 m is negligible for a machine of 0.6 m, a nanometre is not.
    expect(magnitudes.least('m')).toBeGreaterThan(1e-29);
    expect(magnitudes.least('m')).toBeLessThan(1e-9);
    // Forces of joints count for sensors of forces.
    expect(magnitudes.least('N')).toBeCloseTo(900e-11, 12);
    expect(magnitudes.least('unknown')).toBe(0);
  });

  it('make curves of rounding flat', () => {
    const times = Float64Array.from([0, 1]);
    const values = Float32Array.from([1e-29, 0.2]);
    const curve = { label: '', times, values, stride: 1, offset: 0, color: 0, dashed: false };
    expect(aligned(curve, times, 1, magnitudes.least('m'))[0]).toBe(0);
    expect(aligned(curve, times, 1, magnitudes.least('m'))[1]).toBeCloseTo(0.2, 7);
  });
});
