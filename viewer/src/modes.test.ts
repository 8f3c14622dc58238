import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { checkModes, ModeShapes } from './modes';
import { Motion } from './motion';
import { decodeRun, PageDataError } from './run';
import type { PageMode } from './page_data';

function shapesOf(): ModeShapes {
  const data = kVariants['modes']();
  const run = decodeRun(data);
  return new ModeShapes(run, checkModes(data.modes!, run));
}

describe('ModeShapes', () => {
  it('swings to the amplitude at a quarter of the period and back', () => {
    const shapes = shapesOf();
    shapes.show(0, 0.05);
    expect(shapes.period).toBeCloseTo(1 / 53.2, 12);
    const motion = new Motion(shapes.run);
    const mid = () => motion.bodies[0]!.node(6, 1)[1];
    motion.setTime(0);
    expect(mid()).toBeCloseTo(0, 7);
    motion.setTime(0.25 * shapes.period);
    const up = mid();
    expect(up).toBeCloseTo(0.05 * shapes.size, 6);
    motion.setTime(0.75 * shapes.period);
    expect(mid()).toBeCloseTo(-up, 6);
  });

  it('moves the frames of a system by rotation about body axes and translation', () => {
    const shapes = shapesOf();
    shapes.show(1, 0.1);
    const motion = new Motion(shapes.run);
    motion.setTime(0.25 * shapes.period);
    const pose = motion.bodies[0]!.pose;
    // The fixture's second mode: 1 m along y and 0.4 rad about z per unit.
    const factor = 0.1 * shapes.size;
    expect(pose[1]! - 0.2).toBeCloseTo(factor, 5);
    expect(2 * Math.asin(pose[6]!)).toBeCloseTo(0.4 * factor, 5);
  });

  it('shows an unstable mode with a period of one second', () => {
    const shapes = shapesOf();
    shapes.show(2, 0.1);
    expect(shapes.period).toBe(1);
    shapes.show(99, 0.1);
    expect(shapes.index).toBe(2);
  });

  it('swings side by side in phase with the first model, whatever the frequencies', () => {
    const first = shapesOf();
    const data = kVariants['modes']();
    const run = decodeRun(data);
    const slow = data.modes!.map((mode: PageMode) => ({ ...mode, frequency: mode.frequency / 2 }));
    const second = new ModeShapes(run, checkModes(slow, run), first);
    for (const shapes of [first, second]) shapes.show(2, 0.05);
    for (const shapes of [first, second]) shapes.show(0, 0.05);
    expect(second.run.times).toBe(first.run.times);
    const middles = [first, second].map((shapes) => {
      const motion = new Motion(shapes.run);
      motion.setTime(0.75 * first.period);
      return motion.bodies[0]!.node(6, 1)[1];
    });
    expect(middles[0]).toBeCloseTo(-0.05 * first.size, 6);
    expect(middles[1]).toBe(middles[0]);
  });

  it('refuses a list that does not fit the frames', () => {
    const data = kVariants['modes']();
    const run = decodeRun(data);
    expect(() => checkModes(data.modes!.slice(1), run)).toThrow(PageDataError);
  });
});
