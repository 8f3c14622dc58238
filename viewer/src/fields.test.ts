import { describe, expect, it } from 'vitest';
import { BodyField } from './body_field';
import { aligned, allTimes, valueAt } from './chart';
import { indexAt, pointOf } from './field_point';
import { FieldValues, history, rangeOfRun } from './field_values';
import { fieldItems, sourcesOf } from './fields';
import { decodeRun, nodeNumber, nodeNumbered } from './run';
import { magnitude, misesOf, principalOf } from './tensor';
import { kVariants, rows } from '../tests/fixture.mjs';

const cube = () => decodeRun(kVariants.solid());
const kEnd = { index: 49, fraction: 0 };

describe('tensors', () => {
  it('have the invariants of simple states', () => {
    expect(magnitude([9, 2, 3, 6], 1)).toBe(7);
    expect(misesOf([5, 0, 0, 0, 0, 0], 0)).toBe(5);
    expect(misesOf([7, 7, 7, 0, 0, 0], 0)).toBe(0);
    expect(misesOf([0, 0, 0, 1, 0, 0], 0)).toBeCloseTo(Math.sqrt(3), 12);
    const shear = [0, 0, 0, 0, 2, 0];
    expect([0, 1, 2].map((k) => principalOf(shear, 0, k))).toEqual([
      expect.closeTo(2, 12),
      expect.closeTo(0, 12),
      expect.closeTo(-2, 12),
    ]);
    expect([0, 1, 2].map((k) => principalOf([4, 4, 4, 0, 0, 0], 0, k))).toEqual([4, 4, 4]);
  });

  it('keep trace, second invariant and determinant in their principal values', () => {
    const [xx, yy, zz, xy, yz, zx] = [3, -1, 2, 0.5, -1.5, 0.7];
    const p = [0, 1, 2].map((k) => principalOf([xx, yy, zz, xy, yz, zx], 0, k));
    expect(p[0]! >= p[1]! && p[1]! >= p[2]!).toBe(true);
    expect(p[0]! + p[1]! + p[2]!).toBeCloseTo(4, 10);
    expect(p[0]! ** 2 + p[1]! ** 2 + p[2]! ** 2).toBeCloseTo(14 + 2 * (0.25 + 2.25 + 0.49), 10);
    const determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    expect(p[0]! * p[1]! * p[2]!).toBeCloseTo(determinant, 10);
  });
});

describe('fields of a run', () => {
  it('are listed once, stresses first, with what follows from them', () => {
    const ids = fieldItems([cube(), cube()]).map(({ id }) => id);
    expect(new Set(ids).size).toBe(ids.length);
    expect(ids[0]).toBe('von_mises');
    for (const id of ['principal_stress/1', 'stress/xy', 'velocity/magnitude', 'displacement/x']) {
      expect(ids).toContain(id);
    }
  });

  it('prefer places for smooth colours and elements for one colour each', () => {
    const field = new BodyField(cube().bodies[0]!);
    expect(field.source('von_mises', false, false)!.on).toBe('places');
    expect(field.source('von_mises', false, true)!.on).toBe('elements');
    expect(field.source('von_mises', true, false)).toBeNull();
    expect(field.source('displacement/x', false, true)!.on).toBe('nodes');
  });

  it('give values and their range', () => {
    const run = cube();
    const body = run.bodies[0]!;
    const xx = sourcesOf(body).find(({ item }) => item.id === 'stress/xx')!;
    const values = new FieldValues(xx).at(kEnd);
    // 2 MPa · (1 + x): codes resolve 4 MPa / 65534.
    expect(Math.max(...values)).toBeCloseTo(4e6, -2);
    expect(rangeOfRun([run], 'displacement/x')[1]).toBeCloseTo(0.3, 5);
    expect(rangeOfRun([run], 'von_mises_largest')).toEqual([0, 4e6]);
    expect(rangeOfRun([run], 'nothing')).toEqual([0, 0]);
  });

  it('have a history at a node', () => {
    const run = cube();
    const body = run.bodies[0]!;
    const node = nodeNumbered(body, 126);
    expect(nodeNumber(body, node)).toBe(126);
    expect(nodeNumbered(body, 7)).toBe(-1);
    const point = pointOf(body, node);
    expect(point.line).toBe(-1);
    const x = sourcesOf(body).find(({ item }) => item.id === 'displacement/x')!;
    const over = history(x, point.node, run.times.length);
    expect(over[0]).toBeCloseTo(0, 6);
    expect(over[49]).toBeCloseTo(0.3, 5);
    const mises = sourcesOf(body).find(({ item, on }) => item.id === 'von_mises' && on === 'places')!;
    expect(history(mises, point.place, 50)[49]).toBeCloseTo(Math.hypot(4e6, Math.sqrt(3) * 1e5), -3);
  });
});

describe('lines and shells', () => {
  it('have section forces at both ends of every line', () => {
    const run = decodeRun(kVariants['slider-crank']());
    const rod = run.bodies[1]!;
    const source = new BodyField(rod).source('section_moment/Mz', true, false)!;
    expect(source.on).toBe('lineEnds');
    expect(source.item.label).toBe('Bending moment Mz');
    const frame = { index: 60, fraction: 0 };
    const values = new FieldValues(source).at(frame);
    expect(values.length).toBe(24);
    // The value at the end of one element is that at the start of the next.
    for (let e = 0; e + 1 < 12; e++) expect(values[2 * e + 1]).toBe(values[2 * e + 2]);
    expect(indexAt(source, pointOf(rod, 0))).toBe(0);
    expect(indexAt(source, pointOf(rod, 12))).toBe(23);
    expect(values[23]).toBeCloseTo(0, 3);
  });

  it('have stresses side by side, and share items with the solids of their body', () => {
    const data = kVariants.solid();
    const body = data.bodies[0]!;
    const shell = (name: string, components: string[], numbers: number[], level = '') => ({
      name,
      unit: 'Pa',
      components,
      on: 'elements' as const,
      level,
      constant: true,
      values: rows(numbers),
    });
    const of = (values: number[]) => values.concat(Array<number>(8 - values.length).fill(NaN));
    body.fields!.push(
      shell('shell_stress', ['x', 'y', 'xy'], Array(8).fill([3, 1, 2]).flat(), 'layer 2, top'),
      shell('von_mises_largest', [''], of([1, 2, 3])),
      shell('von_mises_largest', [''], of([9, 9, NaN, 4])),
    );
    const run = decodeRun(data);
    const field = new BodyField(run.bodies[0]!);
    const mises = field.source('shell_stress/layer 2, top/von_mises', false, false)!;
    expect(new FieldValues(mises).at(kEnd)[0]).toBeCloseTo(Math.sqrt(9 - 3 + 1 + 12), 6);
    expect(mises.item.label).toBe('Shell von Mises stress, layer 2, top');
    const largest = field.source('von_mises_largest', false, true)!;
    expect([...new FieldValues(largest).at(kEnd)].slice(0, 4)).toEqual([1, 2, 3, 4]);
    expect(rangeOfRun([run], 'von_mises_largest')).toEqual([0, 4e6]);
    expect(history(largest, 3, 2)).toEqual(Float32Array.of(4, 4));
  });
});

describe('curves of two runs', () => {
  const curve = (times: number[], values: number[]) => ({
    label: '',
    times: Float64Array.from(times),
    values: Float32Array.from(values),
    stride: 1,
    offset: 0,
    color: 0,
    dashed: false,
  });

  it('share the instants of both', () => {
    const [a, b] = [curve([0, 1, 2], [1, 2, 3]), curve([0, 0.5, 2], [10, 20, 30])];
    const times = allTimes([a, b]);
    expect([...times]).toEqual([0, 0.5, 1, 2]);
    expect(aligned(a, times, 1)).toEqual([1, undefined, 2, 3]);
    expect(aligned(b, times, 10)).toEqual([1, 2, undefined, 3]);
    expect(valueAt(b, 1.25)).toBeCloseTo(25, 6);
    expect(valueAt(b, 99)).toBe(30);
  });
});
