import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { BodyField } from './body_field';
import { rangeOfRun } from './field_values';
import { fieldItems } from './fields';
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

  it('has colours that tell shares of the largest displacement, whatever the amplitude', () => {
    const shapes = shapesOf();
    const item = 'relative_displacement/magnitude';
    expect(fieldItems([shapes.run]).map(({ id, unit }) => [id, unit])).toContainEqual([item, '']);
    const field = new BodyField(shapes.run.bodies[0]!);
    // A quarter of the period is the 16th of 64 pictures.
    const at = (node: number) => field.at(item, true, false, { index: 16, fraction: 0 })!.values[node];
    for (const amplitude of [0.05, 0.2]) {
      shapes.show(0, amplitude);
      expect(at(6)).toBeCloseTo(1, 6);
      expect(at(3)).toBeCloseTo(Math.sin(Math.PI / 4), 6);
      // Of both the frame's translation and its rotation: 1 + 0.4 x.
      shapes.show(1, amplitude);
      expect(at(12)).toBeCloseTo(1 + 0.4 * 0.4, 6);
      expect(at(0)).toBeCloseTo(1 - 0.4 * 0.4, 6);
    }
    expect(rangeOfRun([shapes.run], item)[0]).toBeCloseTo(0, 6);
    expect(shapes.run.storage).toMatchObject({ shown: 3, records: 3, vibrations: true });
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
