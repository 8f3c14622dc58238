import { describe, expect, it } from 'vitest';
import { Tube } from './tube';
import { PackedRows } from './rows';
import { rows } from '../tests/fixture.mjs';
import type { Body } from './run';
import type { Triple } from './page_data';

function beam(
  nodes: Triple[],
  elements: [number, number][],
  displacement: Float32Array | null,
  radius = elements.map((): [number, number] => [0.1, 0.1]),
): Body {
  return {
    name: 'b',
    kind: 'beam',
    nodes: Float32Array.from(nodes.flat()),
    nodeNumbers: null,
    elements,
    radius,
    sections: null,
    faces: null,
    markers: [],
    pose: new Float32Array(7),
    displacement: displacement && new PackedRows(rows(displacement), displacement.length, 1, 'd'),
    perNode: 6,
    motion: null,
    fields: [],
    shape: null,
    hasRotations: displacement !== null,
  };
}

/** Volume enclosed by the triangles, positive if their fronts face outwards (divergence theorem). */
function volume(tube: Tube): number {
  const p = (v: number) => tube.positions.subarray(3 * v, 3 * v + 3);
  let sum = 0;
  for (let i = 0; i < tube.indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => p(tube.indices[i + k]!));
    sum += a![0]! * (b![1]! * c![2]! - b![2]! * c![1]!);
    sum += a![1]! * (b![2]! * c![0]! - b![0]! * c![2]!);
    sum += a![2]! * (b![0]! * c![1]! - b![1]! * c![0]!);
  }
  return sum / 6;
}

describe('Tube', () => {
  const chain: Triple[] = [
    [0, 0, 0],
    [1, 0, 0],
    [2, 0, 0],
  ];

  it('is a closed prism with its fronts outside', () => {
    const tube = new Tube(
      beam(
        chain,
        [
          [0, 1],
          [1, 2],
        ],
        null,
      ),
      0,
    );
    tube.deform(new Float32Array(18), 0);
    const sides = 16;
    const area = (sides / 2) * 0.1 ** 2 * Math.sin((2 * Math.PI) / sides);
    // Vertices are float32.
    expect(volume(tube)).toBeCloseTo(2 * area, 6);
    expect(tube.kinks).toEqual([]);
  });

  it('stays closed, and every vertex one radius from the centre line, when bent', () => {
    const d = new Float32Array(18);
    d.set([0, 0, 0, 0, 0, 0.3, 0, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.3]);
    const tube = new Tube(
      beam(
        chain,
        [
          [0, 1],
          [1, 2],
        ],
        d,
      ),
      0,
    );
    tube.deform(d, 1);
    const per = tube.elementOf.indexOf(1);
    const ring = (element: number, s: number) =>
      tube.positions.subarray(3 * (element * per + s), 3 * (element * per + s) + 48);
    // The last ring of an element is the first ring of the next one.
    const [last, first] = [ring(0, per - 16), ring(1, 0)];
    for (let i = 0; i < 48; i++) expect(last[i]).toBeCloseTo(first[i]!, 6);
    const middle = ring(1, 0);
    for (let i = 0; i < 48; i += 3) {
      const r = Math.hypot(middle[i]! - 1, middle[i + 1]! - 0.2, middle[i + 2]!);
      expect(r).toBeCloseTo(0.1, 6);
    }
  });

  it('finds bends and branches, and keeps thin beams visible', () => {
    const corner = new Tube(
      beam(
        [
          [0, 0, 0],
          [1, 0, 0],
          [0.2, 0.5, 0],
        ],
        [
          [0, 1],
          [1, 2],
        ],
        null,
      ),
      0.2,
    );
    expect(corner.kinks).toEqual([1]);
    for (const radius of corner.inside.flat()) expect(radius).toBeCloseTo(0.2, 12);
  });

  it('mitres a gentle bend, whichever way its elements run', () => {
    const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
    const bent: Triple[] = [
      [-c, -s, 0],
      [0, 0, 0],
      [c, -s, 0],
    ];
    for (const elements of [
      [[0, 1], [1, 2]],
      [[0, 1], [2, 1]],
      [[1, 0], [2, 1]],
    ] as [number, number][][]) {
      const tube = new Tube(beam(bent, elements, null), 0);
      tube.deform(new Float32Array(18), 0);
      expect(tube.kinks).toEqual([]);
      elements.forEach((ends, e) => {
        const first = 3 * 16 * (2 * e + ends.indexOf(1));
        const ring = tube.positions.subarray(first, first + 48);
        for (let i = 0; i < 48; i += 3) {
          // In the plane between the two, one radius from the axes of both.
          expect(ring[i]).toBeCloseTo(0, 6);
          expect(Math.hypot(c * ring[i + 1]!, ring[i + 2]!)).toBeCloseTo(0.1, 6);
        }
      });
    }
  });

  it('is a closed cone where it tapers, with normals at right angles to its side', () => {
    const tube = new Tube(beam([[0, 0, 0], [3, 0, 0]], [[0, 1]], null, [[0.4, 0.1]]), 0);
    tube.deform(new Float32Array(12), 0);
    const prism = (16 / 2) * Math.sin((2 * Math.PI) / 16);
    // Frustum: h/3 (A + sqrt(A B) + B).
    expect(volume(tube)).toBeCloseTo(prism * (0.4 ** 2 + 0.4 * 0.1 + 0.1 ** 2), 5);
    const side = [0, 1, 2].map((k) => tube.positions[48 + k]! - tube.positions[k]!);
    const normal = tube.normals.subarray(0, 3);
    expect(side[0]! * normal[0]! + side[1]! * normal[1]! + side[2]! * normal[2]!).toBeCloseTo(0, 6);
    expect(Math.hypot(...normal)).toBeCloseTo(1, 6);
  });

  it('closes a step between two radii, and only there', () => {
    const elements: [number, number][] = [[0, 1], [1, 2]];
    const smooth = new Tube(beam(chain, elements, null, [[0.3, 0.2], [0.2, 0.1]]), 0);
    const step = new Tube(beam(chain, elements, null, [[0.3, 0.3], [0.1, 0.1]]), 0);
    step.deform(new Float32Array(18), 0);
    expect(step.positions.length - smooth.positions.length).toBe(2 * 3 * 16);
    const prism = (16 / 2) * Math.sin((2 * Math.PI) / 16);
    expect(volume(step)).toBeCloseTo(prism * (0.3 ** 2 + 0.1 ** 2), 5);
  });

  it('stays within its budget for long models', () => {
    const nodes = [...Array(5001)].map((_, i): Triple => [i, 0, 0]);
    const elements = nodes.slice(1).map((_, i): [number, number] => [i, i + 1]);
    const tube = new Tube(beam(nodes, elements, new Float32Array(6 * 5001)), 0);
    expect(tube.positions.length / 3).toBeLessThan(61000);
  });
});
