import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { colorAt } from './color_map';
import { figure, niceBelow, prefixFor, TimeFormat } from './quantity';
import { decodeRun } from './run';
import { flatten, notices, summaryChips, trustReasons } from './run_summary';

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

  it('bears a summary of nothing', () => {
    const run = decodeRun(kVariants['no-curves']());
    expect(summaryChips(run)).toEqual([]);
    expect(flatten({ a: { b: [1, 2] }, c: 0.5 })).toEqual([
      ['a.b', '1, 2'],
      ['c', '0.500000'],
    ]);
  });
});
