import { describe, expect, it } from 'vitest';
import { LineEnds } from './line_ends';

const chain = (count: number) => [...Array(count)].map((_, e): [number, number] => [e, e + 1]);
/** The recorded value of an element: the larger of its ends. */
const larger = (nodal: number[]) =>
  Float32Array.from(nodal.slice(1).map((b, e) => Math.max(nodal[e]!, b)));
/** The ends of the elements of a chain, from the values at its nodes. */
const ends = (nodal: number[]) => nodal.slice(1).flatMap((b, e) => [nodal[e]!, b]);

describe('LineEnds', () => {
  it('finds the values at the nodes where they grow and where they have a peak', () => {
    for (const nodal of [
      [0, 1, 2, 3, 4],
      [4, 3, 2, 1, 0],
      [0, 2, 4, 2, 0],
      [3, 3, 3],
    ]) {
      const found = new LineEnds(chain(nodal.length - 1)).fill(larger(nodal));
      expect([...found]).toEqual(ends(nodal));
    }
  });

  it('keeps the value of every element at one of its ends, also at a jump', () => {
    const values = Float32Array.from([1, 5, 2, 2.5]);
    const found = new LineEnds(chain(4)).fill(values);
    values.forEach((value, e) => expect(Math.max(found[2 * e]!, found[2 * e + 1]!)).toBe(value));
  });

  it('leaves a single element its value, and does not mix across a branch', () => {
    expect([...new LineEnds([[0, 1]]).fill(Float32Array.from([7]))]).toEqual([7, 7]);
    const star: [number, number][] = [
      [0, 1],
      [0, 2],
      [0, 3],
    ];
    expect([...new LineEnds(star).fill(Float32Array.from([1, 2, 3]))]).toEqual([1, 1, 2, 2, 3, 3]);
  });
});
