import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { runBounds } from './bounds';
import { Motion } from './motion';
import { decodeRun } from './run';
import { Section } from './section';
import type { SectionChoice } from './view_options';

describe('Section', () => {
  const through = (body: string): SectionChoice => ({ axis: 'x', body, fraction: 0.25, flip: false });

  it('goes through the body of that name, wherever it stands in the list, and leaves the others whole', () => {
    const data = kVariants['slider-crank']();
    for (const bodies of [data.bodies, [...data.bodies].reverse()]) {
      const run = decodeRun({ ...data, bodies, joints: [], loads: [] });
      const motion = new Motion(run);
      const section = new Section(runBounds(run), motion.bodies);
      // The rod reaches from −150 to 150 mm along its own x.
      expect(section.coordinate(through('rod'))).toBeCloseTo(-0.075, 6);
      const cut = run.bodies.map((_, i) => section.planes(through('rod'), i) !== null);
      expect(cut).toEqual(run.bodies.map(({ name }) => name === 'rod'));
    }
  });

  it('cuts nothing where the run has no such body, everything without a name', () => {
    const run = decodeRun(kVariants['slider-crank']());
    const section = new Section(runBounds(run), new Motion(run).bodies);
    expect(run.bodies.map((_, i) => section.planes(through('gear'), i))).toEqual([null, null, null]);
    expect(run.bodies.every((_, i) => section.planes(through(''), i))).toBe(true);
    expect(section.planes({ ...through(''), axis: 'off' }, 0)).toBe(null);
  });
});
