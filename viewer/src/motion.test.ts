import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { runBounds } from './bounds';
import { Motion } from './motion';
import { orientationOf } from './orientation';
import { Playback } from './playback';
import { decodeRun } from './run';

const run = (name: keyof typeof kVariants) => decodeRun(kVariants[name]());

describe('Motion', () => {
  it('closes the joints of the slider-crank at every time between frames', () => {
    const motion = new Motion(run('slider-crank'));
    for (const t of [0, 0.0101, 0.05, 0.0999]) {
      motion.setTime(t);
      for (const joint of motion.run.joints.slice(0, 4)) {
        const [a, b] = joint.between.map((side) => motion.side(side, 1));
        const gap = Math.hypot(...a!.map((x, i) => x - b![i]!));
        // Poses are interpolated: chord against arc over one frame, r φ²/8 = 2.6e-5 m.
        expect(gap).toBeLessThan(4e-5);
      }
    }
  });

  it('magnifies the deflection of a marker on a node', () => {
    const motion = new Motion(run('slider-crank'));
    motion.setTime(0.01);
    const rod = motion.bodies[1]!;
    const mid = rod.body.markers[1]!;
    const once = rod.marker(mid, 1)[1];
    expect(Math.abs(once)).toBeGreaterThan(1e-3);
    expect(rod.marker(mid, 20)[1]).toBeCloseTo(20 * once, 12);
  });
});

describe('runBounds', () => {
  it('scales with the model and does not care where it stands', () => {
    const size = runBounds(run('slider-crank')).size;
    expect(size).toBeGreaterThan(0.6);
    expect(runBounds(run('tiny')).size / size).toBeCloseTo(1e-3, 6);
    // 2000 m away float32 resolves 0.12 mm.
    expect(Math.abs(runBounds(run('far')).size - size)).toBeLessThan(1e-3);
  });

  it('holds pulleys as a whole', () => {
    const place = (x: number) => ({ body: -1, marker: -1, position: [x, 0, 0] as [number, number, number] });
    const belt = {
      name: 'belt',
      kind: 'elastic-belt',
      closed: true,
      firstPulley: 0,
      axis: [0, 0, 1] as [number, number, number],
      sides: [place(0), place(10)],
      radii: [2, -3],
    };
    const { center, half } = runBounds({ ...run('slider-crank'), cables: [belt] });
    expect([center[0] - half[0], center[0] + half[0]]).toEqual([-2, 13]);
    expect([center[1] - half[1], center[1] + half[1]]).toEqual([-3, 3]);
    expect(half[2]).toBeLessThan(1);
  });

  it('has a size for nothing at all', () => {
    expect(runBounds(run('no-bodies')).size).toBe(1);
  });
});

describe('orientationOf', () => {
  it('looks at a planar model along its normal, with positive axes to the right', () => {
    expect(orientationOf({ gravity: [0, -9.81, 0], planar: 'xy' })).toMatchObject({
      up: [-0, 1, -0],
      back: [0, 0, 1],
    });
    const fallen = orientationOf({ gravity: [0, 0, -9.81], planar: 'zx' });
    expect(fallen.up[2]).toBe(1);
    expect(fallen.back[1]).toBe(-1);
    expect(orientationOf({ gravity: [0, 0, 0], planar: 'yz' }).back).toEqual([1, 0, 0]);
  });

  it('puts up against gravity in space', () => {
    const { up, back } = orientationOf({ gravity: [0, -1, 0], planar: null });
    expect(up[1]).toBe(1);
    expect(back[1]).toBeGreaterThan(0.3);
    expect(back[2]).toBeGreaterThan(0.5);
  });
});

describe('Playback', () => {
  it('shows the whole run in about eight seconds and begins again', () => {
    const playback = new Playback(Float64Array.of(0, 0.5, 2));
    expect(playback.speed).toBe(0.25);
    playback.advance(1);
    expect(playback.time).toBe(0);
    playback.playing = true;
    playback.advance(7);
    expect(playback.time).toBeCloseTo(1.75, 12);
    playback.advance(2);
    expect(playback.time).toBeCloseTo(0.25, 12);
  });

  it('steps by stored frames and stays inside the run', () => {
    const playback = new Playback(Float64Array.of(0, 0.5, 2));
    playback.setTime(0.6);
    playback.stepFrames(1);
    expect(playback.time).toBe(2);
    playback.stepFrames(1);
    expect(playback.time).toBe(2);
    playback.setTime(-3);
    expect(playback.time).toBe(0);
    playback.setTime(NaN);
    expect(playback.time).toBe(0);
  });

  it('cannot play one frame', () => {
    const playback = new Playback(Float64Array.of(3));
    playback.playing = true;
    playback.advance(1);
    expect(playback.canPlay).toBe(false);
    expect(playback.time).toBe(3);
  });
});
