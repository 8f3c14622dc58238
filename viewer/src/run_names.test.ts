import { describe, expect, it } from 'vitest';
import { kVariants } from '../tests/fixture.mjs';
import { namesOfRuns, titleOf } from './run_names';
import { decodeRun, type Run } from './run';

const run = (title: string, directory: string, changes: string[] = []): Run =>
  decodeRun({ ...kVariants['slider-crank'](), title, directory, changes });

describe('names of runs', () => {
  it('are their titles where these tell them apart', () => {
    const both = [run('Coarse', 'a'), run('Fine', 'b')];
    expect(namesOfRuns(both)).toEqual(['A: Coarse', 'B: Fine']);
    expect(titleOf(both)).toBe('Coarse | Fine');
    expect(namesOfRuns([run('Alone', 'a')])).toEqual(['Alone']);
  });

  it('are directories and what was set where titles are equal', () => {
    const set = ['bodies.rod.beam.elements=32', 'gravity.1=0'];
    const both = [run('Crank', 'coarse', ['gravity.1=0']), run('Crank', 'fine', set)];
    expect(namesOfRuns(both)).toEqual(['A: coarse', 'B: fine · elements=32']);
    expect(titleOf(both)).toBe('Crank – A: coarse | B: fine · elements=32');
  });

  it('are titles again in pages that know no more', () => {
    const both = [run('Crank', ''), run('Crank', '')];
    expect(namesOfRuns(both)).toEqual(['A: Crank', 'B: Crank']);
    expect(titleOf(both)).toBe('Crank');
  });
});
