import { describe, expect, it } from 'vitest';
import { checkBase64, decodeBytes, decodeInts } from './base64';
import { PackedRows, SparseRows, SwingingRows } from './rows';
import { base64, coded, ints, rows } from '../tests/fixture.mjs';

describe('base64', () => {
  it('is read from any byte', () => {
    const bytes = [...Array(20)].map((_, i) => (37 * i) % 256);
    const text = btoa(String.fromCharCode(...bytes));
    for (let from = 0; from < 20; from++) {
      for (let count = 0; from + count <= 20; count++) {
        expect([...decodeBytes(text, from, count, 'x')]).toEqual(bytes.slice(from, from + count));
      }
    }
  });

  it('names what is wrong', () => {
    expect(() => decodeBytes('ab=d', 0, 3, 'faces')).toThrow('faces: not valid base64');
    expect(() => checkBase64('abc', 1, 4, 'faces')).toThrow('faces: not valid base64');
    expect(() => decodeInts(ints([1, 2, 3]), 2, 'faces')).toThrow('3 numbers found, 2 expected');
    expect([...decodeInts(ints([-1, 70000]), 2, 'faces')]).toEqual([-1, 70000]);
  });
});

const kNumbers = [0, 1, 2, 10, 20, 40];

describe('PackedRows', () => {
  it('interpolates float32 between rows and stays at the last', () => {
    const packed = new PackedRows(rows(kNumbers), 3, 2, 'x');
    const out = new Float32Array(3);
    packed.interpolate({ index: 0, fraction: 0.5 }, out);
    expect([...out]).toEqual([5, 10.5, 21]);
    packed.interpolate({ index: 1, fraction: 0 }, out);
    expect([...out]).toEqual([10, 20, 40]);
    expect(packed.value(1, 2)).toBe(40);
    expect(packed.range(1)).toEqual([10, 40]);
  });

  it('keeps codes of 16 bits to half a step of the range of their row', () => {
    const exact = [...Array(50)].map((_, i) => Math.sin(i));
    const packed = new PackedRows(coded(exact, 25), 25, 2, 'x');
    const out = new Float32Array(25);
    for (const frame of [0, 1]) {
      packed.interpolate({ index: frame, fraction: 0 }, out);
      const row = exact.slice(25 * frame, 25 * frame + 25);
      // Half a step is 1/131068 of the range of 2; float32 adds 1e-7.
      row.forEach((x, i) => expect(Math.abs(out[i]! - x)).toBeLessThan(1.6e-5));
      row.forEach((_, i) => expect(packed.value(frame, i)).toBeCloseTo(out[i]!, 6));
    }
  });

  it('hands on what is missing', () => {
    const packed = new PackedRows(coded([1, NaN, 3, 4], 2), 2, 2, 'x');
    const out = new Float32Array(2);
    packed.interpolate({ index: 0, fraction: 0.25 }, out);
    expect(out[0]).toBeCloseTo(1.5, 4);
    expect(out[1]).toBeNaN();
    expect(packed.value(0, 1)).toBeNaN();
    expect(packed.range(0)).toEqual([1, 1]);
  });

  it('refuses rows that are too few, of an unknown type, or without ranges', () => {
    expect(() => new PackedRows(rows([1, 2]), 3, 1, 'b.d')).toThrow('b.d: 2 numbers found, 3 expected');
    const odd = { type: 'f64', values: base64([1]) } as unknown as ReturnType<typeof rows>;
    expect(() => new PackedRows(odd, 1, 1, 'b.d')).toThrow('b.d: unknown type');
    const { type, values } = coded([1, 2], 2);
    expect(() => new PackedRows({ type, values }, 2, 1, 'b.d')).toThrow('b.d.ranges');
  });
});

describe('SwingingRows', () => {
  it('is the chosen shape times the factors', () => {
    const swinging = new SwingingRows(
      new PackedRows(rows(kNumbers), 3, 2, 'x'),
      Float64Array.of(0, 2, -1),
    );
    swinging.choose(1);
    const out = new Float32Array(3);
    swinging.interpolate({ index: 0, fraction: 0.5 }, out);
    expect([...out]).toEqual([10, 20, 40]);
    expect(swinging.value(2, 1)).toBe(-20);
    expect(swinging.range(2)).toEqual([-40, -10]);
  });
});

describe('SparseRows', () => {
  it('are linear between their frames and stay at the ends', () => {
    const sparse = new SparseRows(new PackedRows(rows([0, 8]), 1, 2, 'x'), Int32Array.of(2, 6), 9);
    const at = (index: number, fraction = 0) => {
      const out = new Float32Array(1);
      sparse.interpolate({ index, fraction }, out);
      return out[0];
    };
    expect([at(0), at(2), at(3), at(3, 0.5), at(6), at(8)]).toEqual([0, 0, 2, 3, 8, 8]);
    expect([0, 3, 8].map((frame) => sparse.value(frame, 0))).toEqual([0, 2, 8]);
    expect(sparse.range(4)).toEqual([0, 8]);
    expect(sparse.range(8)).toEqual([8, 8]);
  });
});
