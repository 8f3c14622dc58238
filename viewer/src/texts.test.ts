import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { tickTexts } from './chart';
import { colorAt } from './color_map';
import { figure, niceBelow, prefixFor, TimeFormat } from './quantity';
import { decodeRun } from './run';
import { notices, summaryChips, trustReasons } from './run_summary';
import { summaryGroups } from './summary_table';

describe('quantities', () => {
  it('choose the prefix an engineer would', () => {
    expect(prefixFor(0.0074, 'm').unit).toBe('mm');
    expect(prefixFor(0.2, 'm').unit).toBe('m');
    expect(prefixFor(4.9e8, 'Pa').unit).toBe('MPa');
    expect(prefixFor(3000, 'm').unit).toBe('m');
    expect(prefixFor(3000, 'N m').unit).toBe('kN m');
    expect(prefixFor(1e-8, 'm^2').unit).toBe('m^2');
    expect(prefixFor(0, 'm').unit).toBe('m');
  });

  it('read as figures', () => {
    expect(figure(50, 1)).toBe('50');
    expect(figure(-0.5)).toBe('−0.5000');
    expect(figure(3.1e-14, 2)).toBe('3.1e−14');
    expect(figure(NaN)).toBe('–');
    expect(niceBelow(0.07)).toBeCloseTo(0.05, 12);
    expect(new TimeFormat(0.02, 's').number(0.0123)).toBe('12.30');
    expect(new TimeFormat(0.02, 's').unit).toBe('ms');
    expect(new TimeFormat(0, 's').number(0)).toBe('0.000');
    expect(new TimeFormat(0.5, 'steps').unit).toBe('steps');
  });

  it('ticks of an axis can be told apart', () => {
    expect(tickTexts([0, 0.25, 0.5])).toEqual(['0', '0.25', '0.5']);
    expect(tickTexts([-200, 0, 200])).toEqual(['−200', '0', '200']);
    expect(tickTexts([0.99999, 0.999995, 1])).toEqual(['0.99999', '0.999995', '1']);
    expect(tickTexts([2e5])).toEqual(['2.0e5']);
  });

  it('colour runs from blue to red and is clamped', () => {
    const [low, high] = [colorAt(-1), colorAt(2)];
    expect(low[2]).toBeGreaterThan(low[0]);
    expect(high[0]).toBeGreaterThan(high[2]);
    expect(colorAt(NaN)).toEqual(low);
  });
});

describe('run summary', () => {
  it('shows what a good run did', () => {
    const run = decodeRun(kVariants['slider-crank']());
    const chips = summaryChips(run).map(({ label, value, tone }) => [label, value, tone]);
    expect(chips).toContainEqual(['factorisations', '1', 'plain']);
    expect(chips).toContainEqual(['trust', 'ok', 'good']);
  });

  it('warns about a run that is not to be trusted', () => {
    const run = decodeRun(kVariants.spatial());
    expect(trustReasons(run.summary)).toEqual(['step too large for the highest mode']);
    expect(notices(run.summary)).toHaveLength(2);
    expect(summaryChips(run).filter((chip) => chip.tone === 'warn')).toHaveLength(2);
  });

  it('says when the run was still going on, or was interrupted', () => {
    expect(notices({ status: 'running' })).toEqual([
      'Written while the run was still going on, or after it was killed.',
    ]);
    expect(notices({ status: 'finished', finished: true, interrupted: null })).toEqual([]);
    expect(notices({ finished: false, interrupted: 'Ctrl-C at t = 0.2 s' })).toEqual([
      'Interrupted: Ctrl-C at t = 0.2 s',
    ]);
  });

  it('puts every figure into words', () => {
    const groups = summaryGroups({
      title: 'shown elsewhere',
      end_time: 0.1,
      step_control: { controlled: false, sizes: [{ step: 5e-5, steps: 2000 }] },
      bodies: { rod_2: { dof: 51, largest_strain: 1.4e-4, some_new_key: 3 } },
      residuals: { position: 6.1e-16 },
      analyses: [{ modes: [{ effective_mass: [2, 5e-35, 0.5] }] }],
      nothing: null,
    });
    expect(groups).toEqual([
      { title: 'Run', rows: [['Simulated time [s]', '0.10000']] },
      { title: 'Time steps', rows: [['Step chosen by the estimated error', 'no']] },
      { title: 'Step length 1', rows: [['Step [s]', '5.00e−5'], ['Steps', '2000']] },
      {
        title: 'Body rod_2',
        rows: [['Nodal variables', '51'], ['Largest strain', '1.40e−4'], ['Some new key', '3']],
      },
      { title: 'Largest violations of the joints', rows: [['Position [m or rad]', '6.10e−16']] },
      { title: 'Mode 1.1', rows: [['Effective mass x, y, z [kg]', '2, 0, 0.50000']] },
    ]);
  });

  it('tell where the energy went', () => {
    const groups = summaryGroups({
      energy_account: {
        brought_in: { drives: { motor: 5 } },
        lost: { 'joint-friction': { pin: 2, '3': 1 }, impacts: { model: 0.25 } },
        kept: { kinetic: { model: 1.5 } },
        unexplained: 0.25,
      },
    });
    expect(groups).toEqual([
      { title: 'Energy brought in [J]', rows: [['Drives: motor', '5']] },
      {
        title: 'Energy lost [J]',
        rows: [
          ['Joint friction: 3', '1'],
          ['Joint friction: pin', '2'],
          ['Impacts', '0.25000'],
        ],
      },
      { title: 'Energy kept [J]', rows: [['Kinetic', '1.5000']] },
      { title: 'Energy account [J]', rows: [['Unexplained', '0.25000']] },
    ]);
  });

  it('bears a summary of nothing', () => {
    const run = decodeRun(kVariants['no-curves']());
    expect(summaryChips(run)).toEqual([]);
    expect(summaryGroups({})).toEqual([]);
  });
});
