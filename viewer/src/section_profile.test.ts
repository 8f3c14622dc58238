import { describe, expect, it } from 'vitest';
import { Tube } from './tube';
import { circle, profileOf, type Loop } from './section_profile';
import type { Body, Sections } from './run';
import type { Triple } from './page_data';

const rectangle = (width: number, height: number): Loop => [
  [width / 2, height / 2],
  [-width / 2, height / 2],
  [-width / 2, -height / 2],
  [width / 2, -height / 2],
];
const hole = (loop: Loop): Loop => [...loop].reverse();

function beam(nodes: Triple[], elements: [number, number][], sections: Sections): Body {
  return {
    name: 'b',
    kind: 'beam',
    nodes: Float32Array.from(nodes.flat()),
    nodeNumbers: null,
    elements,
    radius: elements.map((): [number, number] => [1, 1]),
    sections,
    faces: null,
    markers: [],
    pose: new Float32Array(7),
    displacement: null,
    perNode: 6,
    motion: null,
    shape: null,
    fields: [],
    hasRotations: false,
  };
}

const along = (count: number, axis: Triple) => Float32Array.from(Array(count).fill(axis).flat());

/** Volume inside the triangles, positive if their fronts look outwards (divergence theorem). */
function volume({ positions, indices }: Tube): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * indices[i + k]!, 3 * indices[i + k]! + 3));
    sum += a![0]! * (b![1]! * c![2]! - b![2]! * c![1]!);
    sum += a![1]! * (b![2]! * c![0]! - b![0]! * c![2]!);
    sum += a![2]! * (b![0]! * c![1]! - b![1]! * c![0]!);
  }
  return sum / 6;
}

/** Extent of the vertices along each axis. */
function extents({ positions }: Tube): Triple {
  return [0, 1, 2].map((k) => {
    const values = positions.filter((_, i) => i % 3 === k);
    return Math.max(...values) - Math.min(...values);
  }) as Triple;
}

const kStraight: Triple[] = [
  [0, 0, 0],
  [2, 0, 0],
];

describe('profileOf', () => {
  it('keeps the corners of a rectangle sharp and a circle smooth', () => {
    const sharp = profileOf([rectangle(0.4, 0.1)]);
    expect(sharp.points).toHaveLength(8);
    for (const [y, z] of sharp.normals) expect(Math.abs(y) + Math.abs(z)).toBeCloseTo(1, 12);
    // Normals point away from the material.
    sharp.points.forEach((p, i) => {
      expect(p[0] * sharp.normals[i]![0] + p[1] * sharp.normals[i]![1]).toBeGreaterThan(0);
    });
    expect(sharp.inside).toBeCloseTo(0.05, 12);
    const smooth = profileOf([circle(0.3, 24), hole(circle(0.2, 24))]);
    expect(smooth.points).toHaveLength(48);
    expect(smooth.radius).toBeCloseTo(0.3, 12);
    // Those of a hole point into it.
    const inner = smooth.points.findIndex(([y, z]) => Math.hypot(y, z) < 0.25);
    const [p, n] = [smooth.points[inner]!, smooth.normals[inner]!];
    expect(p[0] * n[0] + p[1] * n[1]).toBeCloseTo(-0.2, 12);
    expect(profileOf([circle(0.3, 24), hole(circle(0.2, 24))], 2).points).toHaveLength(24);
  });
});

describe('sections along beams', () => {
  it('have their width along y and their height along z of the element', () => {
    const loops = [[rectangle(0.4, 0.1)]];
    const at = Int32Array.from([0, 0]);
    const flat = new Tube(beam(kStraight, [[0, 1]], { loops, at, axes: along(1, [0, 1, 0]) }), 0);
    flat.deform(new Float32Array(12), 0);
    // Vertices are float32.
    expect(volume(flat)).toBeCloseTo(2 * 0.4 * 0.1, 6);
    extents(flat).forEach((x, k) => expect(x).toBeCloseTo([2, 0.4, 0.1][k]!, 6));
    const upright = new Tube(beam(kStraight, [[0, 1]], { loops, at, axes: along(1, [0, 0, 1]) }), 0);
    upright.deform(new Float32Array(12), 0);
    extents(upright).forEach((x, k) => expect(x).toBeCloseTo([2, 0.1, 0.4][k]!, 6));
  });

  it('are hollow where they have a hole', () => {
    for (const [outer, inner, area] of [
      [rectangle(0.4, 0.2), rectangle(0.3, 0.1), 0.08 - 0.03],
      [circle(0.2, 24), circle(0.1, 24), 12 * Math.sin(Math.PI / 12) * (0.04 - 0.01)],
    ] as [Loop, Loop, number][]) {
      const sections = { loops: [[outer, hole(inner)]], at: Int32Array.from([0, 0]), axes: along(1, [0, 1, 0]) };
      const tube = new Tube(beam(kStraight, [[0, 1]], sections), 0);
      tube.deform(new Float32Array(12), 0);
      expect(volume(tube)).toBeCloseTo(2 * area, 6);
    }
  });

  it('taper from end to end', () => {
    const loops = [[rectangle(0.4, 0.2)], [rectangle(0.2, 0.2)]];
    const sections = { loops, at: Int32Array.from([0, 1]), axes: along(1, [0, 1, 0]) };
    const tube = new Tube(beam(kStraight, [[0, 1]], sections), 0);
    tube.deform(new Float32Array(12), 0);
    expect(volume(tube)).toBeCloseTo(2 * 0.3 * 0.2, 6);
  });

  it('keep their width around a corner, mitred at half the angle', () => {
    const corner: Triple[] = [
      [0, 0, 0],
      [2, 0, 0],
      [2, 2, 0],
    ];
    // The width lies in the plane of the corner.
    const axes = Float32Array.from([0, 1, 0, -1, 0, 0]);
    const sections = { loops: [[rectangle(0.4, 0.2)]], at: Int32Array.from([0, 0, 0, 0]), axes };
    const tube = new Tube(beam(corner, [[0, 1], [1, 2]], sections), 0);
    tube.deform(new Float32Array(18), 0);
    expect(tube.kinks).toEqual([]);
    // Two beams of 2 m from axis to axis: the outer side gains what the inner one loses.
    expect(volume(tube)).toBeCloseTo(4 * 0.4 * 0.2, 6);
    extents(tube).forEach((x, k) => expect(x).toBeCloseTo([2.2, 2.2, 0.2][k]!, 6));
    // Normals are those of the sides, up to the corner.
    for (let i = 0; i < tube.normals.length; i += 3) {
      const sizes = [...tube.normals.subarray(i, i + 3)].map(Math.abs);
      expect(Math.max(...sizes)).toBeCloseTo(1, 5);
    }
  });

  it('turn with the rotations of the nodes', () => {
    const sections = { loops: [[rectangle(0.4, 0.1)]], at: Int32Array.from([0, 0]), axes: along(1, [0, 1, 0]) };
    const body = { ...beam(kStraight, [[0, 1]], sections), hasRotations: true };
    const tube = new Tube(body, 0);
    // A quarter turn of the second end about x.
    tube.deform([0, 0, 0, 0, 0, 0, 0, 0, 0, Math.PI / 2, 0, 0], 1);
    const last = [...tube.alongOf].map((s, v) => (s === 1 ? v : -1)).filter((v) => v >= 0);
    expect(last.length).toBeGreaterThan(0);
    for (const v of last) {
      expect(Math.abs(tube.positions[3 * v + 1]!)).toBeCloseTo(0.05, 6);
      expect(Math.abs(tube.positions[3 * v + 2]!)).toBeCloseTo(0.2, 6);
    }
  });
});
