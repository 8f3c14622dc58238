import { describe, expect, it } from 'vitest';
import { Surface } from './surface';
import { ElementFaces } from './element_faces';
import { faceValue, VertexValues } from './surface_values';
import { decodeRun, PageDataError, type Body } from './run';
import { base64, ints, rows } from '../tests/fixture.mjs';
import type { PageBody, PageRun, Triple } from './page_data';

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

function page(change: Partial<PageBody> = {}): PageRun {
  const body: PageBody = {
    name: 'cube',
    kind: 'solid',
    nodes: base64(kNodes.flat()),
    elements: [],
    radius: [],
    markers: [],
    faces: ints(kFaces.flat()),
    faceElements: ints(kFaces.map(() => 0)),
    pose: base64([0, 0, 0, 1, 0, 0, 0]),
    displacement: rows(kNodes.flatMap(([x, y, z]) => [0.1 * x, 0.2 * y, 0.3 * z])),
    ...change,
  };
  return {
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

const bodyOf = (change: Partial<PageBody> = {}): Body => decodeRun(page(change)).bodies[0]!;
const kStart = { index: 0, fraction: 0 };

function volume({ positions, indices }: Pick<Surface, 'positions' | 'indices'>): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * indices[i + k]!));
    sum += a![0]! * (b![1]! * c![2]! - b![2]! * c![1]!);
    sum += a![1]! * (b![2]! * c![0]! - b![0]! * c![2]!);
    sum += a![2]! * (b![0]! * c![1]! - b![1]! * c![0]!);
  }
  return sum / 6;
}

describe('edges of quadratic elements', () => {
  // A face of tet10: corners 0 1 2, mid-side nodes 3 4 5, in four pieces.
  const nodes = [0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
  const quadratic = (faceEdges: string | null) =>
    bodyOf({
      nodes: base64(nodes),
      faces: ints([0, 3, 5, -1, 1, 4, 3, -1, 2, 5, 4, -1, 3, 4, 5, -1]),
      faceElements: ints([0, 0, 0, 0]),
      faceEdges,
      displacement: null,
    });

  it('leave out the lines between the pieces of a face', () => {
    const { edges, nodeOf, isOpen } = new Surface(quadratic(ints([0b101, 0b101, 0b101, 0])));
    const pairs = [...Array(edges.length / 2)].map((_, i) =>
      [edges[2 * i]!, edges[2 * i + 1]!].map((v) => nodeOf[v]!).sort().join(' '),
    );
    expect(pairs.sort()).toEqual(['0 3', '0 5', '1 3', '1 4', '2 4', '2 5']);
    expect(isOpen).toBe(true);
    // Without this information all sides are drawn.
    expect(new Surface(quadratic(null)).edges).toHaveLength(2 * 9);
  });

  it('are refused in another number than there are faces', () => {
    expect(() => quadratic(ints([7]))).toThrow('faceEdges: 1 found, 4 expected');
  });
});

describe('solid bodies of a page', () => {
  it('have translations only', () => {
    const body = bodyOf();
    expect(body.kind).toBe('solid');
    expect(body.perNode).toBe(3);
    expect(body.displacement!.value(0, 3 * 7 + 2)).toBeCloseTo(0.15, 6);
    expect(body.hasRotations).toBe(false);
  });

  it('are refused with faces on missing nodes, or with too few elements', () => {
    expect(() => page({ faces: ints([0, 1, 9, 3]), faceElements: ints([0]) })).not.toThrow();
    expect(() => bodyOf({ faces: ints([0, 1, 9, 3]), faceElements: ints([0]) })).toThrow(PageDataError);
    expect(() => bodyOf({ faces: ints([0, 1, -1, 3]), faceElements: ints([0]) })).toThrow('no node -1');
    expect(() => bodyOf({ faces: ints([0, 1, 3, -1]), faceElements: ints([0]) })).not.toThrow();
    expect(() => bodyOf({ faceElements: ints([0]) })).toThrow('not as many elements');
  });
});

describe('Surface', () => {
  it('encloses the deformed volume and has edges where the body has', () => {
    const body = bodyOf();
    const surface = new Surface(body);
    expect(surface.nodeOf).toHaveLength(24);
    expect(surface.edges).toHaveLength(2 * 12);
    expect(surface.outline).toHaveLength(2 * 12);
    expect(surface.isOpen).toBe(false);
    surface.deform(new Float32Array(24), 1);
    expect(volume(surface)).toBeCloseTo(1, 6);
    const moved = new Float32Array(24);
    body.displacement!.interpolate(kStart, moved);
    surface.deform(moved, 1);
    expect(volume(surface)).toBeCloseTo(1.1 * 1.2 * 1.3, 5);
    // Normals are perpendicular to the faces.
    for (let v = 0; v < surface.normals.length; v += 3) {
      const n = [...surface.normals.subarray(v, v + 3)];
      expect(Math.max(...n.map(Math.abs))).toBeCloseTo(1, 6);
    }
  });

  it('knows the face of a triangle among faces of three and four corners', () => {
    const faces = ints([0, 2, 3, 1, 4, 5, 7, -1, 0, 1, 5, 4]);
    const surface = new Surface(bodyOf({ faces, faceElements: ints([0, 1, 2]) }));
    expect([0, 1, 2, 3, 4].map((triangle) => surface.faceOf(triangle))).toEqual([0, 0, 1, 2, 2]);
  });

  it('parts vertices where a node has two places', () => {
    const places = kFaces.map((face, f) => face.map((node) => (f === 0 ? node : 8 + node)));
    const surface = new Surface(bodyOf({ facePlaces: ints(places.flat()) }));
    const ofFirst = [...surface.placeOf].filter((place) => place < 8);
    expect(ofFirst.sort()).toEqual([0, 1, 2, 3]);
  });

  describe('of two faces that meet at a small angle', () => {
    const bent: Triple[] = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [1, 1, 0],
      [2, 0, -0.2],
      [2, 1, -0.2],
    ];
    const body = bodyOf({
      nodes: base64(bent.flat()),
      displacement: null,
      faces: ints([0, 1, 3, 2, 1, 4, 5, 3]),
      faceElements: ints([0, 1]),
    });

    it('is smooth, with the mean of the elements at their common nodes', () => {
      const surface = new Surface(body);
      expect(surface.nodeOf).toHaveLength(6);
      const values = new Float32Array(6);
      const painted = { on: 'elements' as const, values: new Float32Array([1, 3]) };
      new VertexValues(surface, body.faces!).fill(painted, values);
      expect([...surface.nodeOf].map((node, v) => [node, values[v]]).sort()).toEqual([
        [0, 1],
        [1, 2],
        [2, 1],
        [3, 2],
        [4, 3],
        [5, 3],
      ]);
    });

    it('has a rim, which is its outline', () => {
      const surface = new Surface(body);
      expect(surface.isOpen).toBe(true);
      expect(surface.edges).toHaveLength(2 * 7);
      expect(surface.outline).toHaveLength(2 * 6);
    });
  });
});

describe('ElementFaces', () => {
  it('ends every triangle of a face at a vertex that no other face ends at', () => {
    const surface = new Surface(bodyOf());
    const faces = new ElementFaces(surface);
    expect(new Set(faces.carrier).size).toBe(6);
    expect(faces.indices).toHaveLength(3 * 12);
    for (let t = 0; t < 12; t++) {
      expect(faces.indices[3 * t + 2]).toBe(faces.carrier[t >> 1]);
    }
    faces.update();
    expect(volume({ positions: faces.positions, indices: faces.indices })).toBeCloseTo(1, 6);
  });

  it('doubles vertices where faces outnumber them', () => {
    // A fan of seven triangles without a vertex for each.
    const rim = [...Array(6)].map((_, i) => [Math.cos(i), Math.sin(i), 0]);
    const fan = [...Array(5)].flatMap((_, i) => [0, i + 1, i + 2, -1]);
    const twice = [...fan, ...fan];
    const body = bodyOf({
      nodes: base64([0, 0, 0, ...rim.flat()]),
      displacement: null,
      faces: ints(twice),
      faceElements: ints([...Array(10).keys()]),
    });
    const surface = new Surface(body);
    const faces = new ElementFaces(surface);
    expect(new Set(faces.carrier).size).toBe(10);
    expect(faces.vertexOf.length).toBe(10);
    const painted = { on: 'nodes' as const, values: Float32Array.from([0, 3, 6, 9, 12, 15, 18]) };
    expect(faceValue(surface, body.faces!, painted, 0)).toBeCloseTo(3, 6);
  });
});
