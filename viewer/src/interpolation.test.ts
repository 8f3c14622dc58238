import { describe, expect, it } from 'vitest';
import { interpolatePose, interpolateRow, locate } from './interpolation';

const times = [0, 1, 1.5, 4];

describe('locate', () => {
  it('finds the interval of unevenly spaced frames', () => {
    expect(locate(times, 0.25)).toEqual({ index: 0, fraction: 0.25 });
    expect(locate(times, 1)).toEqual({ index: 1, fraction: 0 });
    expect(locate(times, 2.75)).toEqual({ index: 2, fraction: 0.5 });
  });

  it('is clamped to the run and bears runs of one frame, of none, and NaN', () => {
    expect(locate(times, -1)).toEqual({ index: 0, fraction: 0 });
    expect(locate(times, 9)).toEqual({ index: 3, fraction: 0 });
    expect(locate([2], 5)).toEqual({ index: 0, fraction: 0 });
    expect(locate([], 5)).toEqual({ index: 0, fraction: 0 });
    expect(locate(times, NaN)).toEqual({ index: 0, fraction: 0 });
  });
});

describe('interpolateRow', () => {
  it('is linear and does not read past the last frame', () => {
    const values = Float32Array.of(0, 10, 2, 20);
    const out: number[] = [];
    interpolateRow(values, 2, { index: 0, fraction: 0.5 }, out);
    expect(out).toEqual([1, 15]);
    interpolateRow(values, 2, { index: 1, fraction: 0 }, out);
    expect(out).toEqual([2, 20]);
  });
});

const aboutZ = (angle: number) => [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)];

describe('interpolatePose', () => {
  it('turns at constant rate', () => {
    const pose = Float32Array.of(0, 0, 0, ...aboutZ(0.2), 1, 2, 4, ...aboutZ(1.4));
    const out: number[] = [];
    interpolatePose(pose, { index: 0, fraction: 0.25 }, out);
    expect(out.slice(0, 3)).toEqual([0.25, 0.5, 1]);
    // Poses are float32: seven digits.
    expect(2 * Math.atan2(out[6]!, out[3]!)).toBeCloseTo(0.2 + 0.25 * 1.2, 6);
  });

  it('takes the short way between a quaternion and its negative', () => {
    const flipped = aboutZ(0.4).map((x) => -x);
    const pose = Float32Array.of(0, 0, 0, ...aboutZ(0.2), 0, 0, 0, ...flipped);
    const out: number[] = [];
    interpolatePose(pose, { index: 0, fraction: 0.5 }, out);
    expect(2 * Math.atan2(out[6]!, out[3]!)).toBeCloseTo(0.3, 6);
  });

  it('gives a unit quaternion for equal and nearly equal poses', () => {
    for (const angle of [0.2, 0.2001]) {
      const pose = Float32Array.of(0, 0, 0, ...aboutZ(0.2), 0, 0, 0, ...aboutZ(angle));
      const out: number[] = [];
      interpolatePose(pose, { index: 0, fraction: 0.5 }, out);
      expect(Math.hypot(...out.slice(3))).toBeCloseTo(1, 12);
    }
  });
});
