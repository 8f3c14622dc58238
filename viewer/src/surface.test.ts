import { describe, expect, it } from 'vitest';
import { Surface } from './surface';
import { decodeRun, largestStress, PageDataError, type Body } from './run';
import { base64 } from '../tests/fixture.mjs';
import type { PageData, Triple } from './page_data';

/** Unit cube of one element about the origin. */
const kNodes = [0, 1, 2, 3, 4, 5, 6, 7].map(
  (n) => [(n % 2) - 0.5, (Math.floor(n / 2) % 2) - 0.5, Math.floor(n / 4) - 0.5] as Triple,
);
const kFaces: [number, number, number, number][] = [
  [0, 2, 3, 1],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 4, 6, 2],
  [1, 3, 7, 5],
];

function page(change: Partial<PageData['bodies'][0]> = {}): PageData {
  const body = {
    name: 'cube',
    kind: 'solid' as const,
    nodes: kNodes,
    elements: [],
    radius: [],
    markers: [],
    faces: kFaces,
    faceElements: kFaces.map(() => 0),
    pose: base64([0, 0, 0, 1, 0, 0, 0]),
    displacement: base64(kNodes.flatMap(([x, y, z]) => [0.1 * x, 0.2 * y, 0.3 * z])),
    stress: null,
    solidStress: base64([5e6]),
    ...change,
  };
  return {
    format: 1,
    title: 't',
    version: '',
    generated: '',
    time: { n: 1, f32: base64([0]) },
    bodies: [body],
    joints: [],
    gravity: [0, 0, 0],
    planar: null,
    sensors: [],
    energies: [],
    summary: {},
  };
}

const cube = (): Body => decodeRun(page()).bodies[0]!;

function volume({ positions, indices }: Surface): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * indices[i + k]!));
    sum += a![0]! * (b![1]! * c![2]! - b![2]! * c![1]!);
    sum += a![1]! * (b![2]! * c![0]! - b![0]! * c![2]!);
    sum += a![2]! * (b![0]! * c![1]! - b![1]! * c![0]!);
  }
  return sum / 6;
}

describe('solid bodies of a page', () => {
  it('get zero rotations and keep their stresses', () => {
    const run = decodeRun(page());
    const body = run.bodies[0]!;
    expect(body.kind).toBe('solid');
    expect(body.displacement).toHaveLength(48);
    expect(body.displacement![6 * 7 + 2]).toBeCloseTo(0.15, 6);
    expect(body.displacement![6 * 7 + 3]).toBe(0);
    expect(body.hasRotations).toBe(false);
    expect(largestStress(run)).toBe(5e6);
  });

  it('are refused with faces on missing nodes', () => {
    expect(() => decodeRun(page({ faces: [[0, 1, 9, 3]] }))).toThrow(PageDataError);
    expect(() => decodeRun(page({ faces: [[0, 1, 3, -1]] }))).not.toThrow();
  });
});

describe('Surface', () => {
  it('encloses the deformed volume and has edges where the body has', () => {
    const surface = new Surface(cube());
    expect(surface.nodeOf).toHaveLength(24);
    expect(surface.edges).toHaveLength(2 * 12);
    surface.deform(new Float32Array(48), 1);
    expect(volume(surface)).toBeCloseTo(1, 6);
    surface.deform(cube().displacement!, 1);
    expect(volume(surface)).toBeCloseTo(1.1 * 1.2 * 1.3, 5);
    // Normals stand on the faces.
    for (let v = 0; v < surface.normals.length; v += 3) {
      const n = [...surface.normals.subarray(v, v + 3)];
      expect(Math.max(...n.map(Math.abs))).toBeCloseTo(1, 6);
    }
  });

  it('is smooth where faces meet at small angles', () => {
    const bent: Triple[] = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [1, 1, 0],
      [2, 0, -0.2],
      [2, 1, -0.2],
    ];
    const faces: Body['faces'] = [
      [0, 1, 3, 2],
      [1, 4, 5, 3],
    ];
    const surface = new Surface({ ...cube(), nodes: bent, faces, faceElements: [0, 1] });
    expect(surface.nodeOf).toHaveLength(6);
    const values = new Float32Array(6);
    surface.vertexValues(new Float32Array([1, 3]), values);
    expect(surface.nodeOf.map((node, v) => [node, values[v]]).sort()).toEqual([
      [0, 1],
      [1, 2],
      [2, 1],
      [3, 2],
      [4, 3],
      [5, 3],
    ]);
  });
});
