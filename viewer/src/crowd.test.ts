import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { chain } from '../tests/chain_fixture.mjs';
import { runBounds } from './bounds';
import { Copies, kFrame, putPose } from './copies';
import { Crowd } from './crowd';
import { crowdJoint, isCrowd } from './crowd_size';
import { kMostNames, namesOf, spread } from './names';
import { Motion } from './motion';
import { largestReactions } from './reaction_view';
import { decodeRun } from './run';
import { startOptions } from './start_options';
import { kLight } from './theme';

const kLinks = 600;

const kEverything = new THREE.Frustum(
  ...([...Array(6)].map(() => new THREE.Plane(new THREE.Vector3(1, 0, 0), 1e9)) as [
    THREE.Plane, THREE.Plane, THREE.Plane, THREE.Plane, THREE.Plane, THREE.Plane,
  ]),
);
/** Only what is at x > 500. */
const kPart = kEverything.clone();
kPart.planes[0] = new THREE.Plane(new THREE.Vector3(1, 0, 0), -500);

function crowd() {
  const run = decodeRun(chain(kLinks));
  const motion = new Motion(run);
  const joint = crowdJoint(run, 10);
  const made = new Crowd(motion, run.joints, new Set(), largestReactions(run), kLight, joint);
  const copies: THREE.InstancedMesh[] = [];
  made.root.traverse((object) => {
    if (object instanceof THREE.InstancedMesh) copies.push(object);
  });
  return { run, motion, joint, made, copies, options: startOptions([]) };
}

function placeOf(mesh: THREE.InstancedMesh, index: number, from: [number, number, number]): number[] {
  const matrix = new THREE.Matrix4();
  mesh.getMatrixAt(index, matrix);
  return new THREE.Vector3(...from).applyMatrix4(matrix).toArray();
}

describe('Copies', () => {
  it('sit within frames that move', () => {
    const places = { owners: Int32Array.of(1, 1), frames: new Float32Array(2 * kFrame) };
    places.frames.set([1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0]);
    const copies = new Copies(new THREE.BoxGeometry(), places, 'red');
    const frames = new Float32Array(2 * kFrame);
    const half = Math.SQRT1_2;
    putPose([5, 6, 7, half, 0, 0, half], frames, 1);
    copies.update(frames, Uint8Array.of(0, 1));
    expect(copies.mesh.count).toBe(2);
    // Single precision of numbers up to ten.
    placeOf(copies.mesh, 0, [1, 0, 0]).forEach((x, i) => expect(x).toBeCloseTo([5, 7, 7][i]!, 5));
    placeOf(copies.mesh, 1, [1, 0, 0]).forEach((x, i) => expect(x).toBeCloseTo([5, 9, 7][i]!, 5));
    copies.update(frames, Uint8Array.of(1, 0));
    expect(copies.mesh.count).toBe(0);
  });
});

describe('Crowd', () => {
  it('is for runs of more than a thousand parts', () => {
    expect(isCrowd(decodeRun(chain(500)))).toBe(false);
    expect(isCrowd(decodeRun(chain(501)))).toBe(true);
  });

  it('draws bars to the markers in a few calls', () => {
    const { motion, made, copies, options, joint } = crowd();
    expect(copies.length).toBeLessThan(10);
    expect(joint).toBeCloseTo(0.125, 12);
    motion.setTime(1);
    made.update(options, 0, kEverything);
    const bars = copies[0]!;
    expect(bars.count).toBe(2 * kLinks);
    // The second bar of link 7 ends at its marker b, which points along y now.
    placeOf(bars, 15, [0, 0, 1]).forEach((x, i) => expect(x).toBeCloseTo([7, 2.5, 0][i]!, 5));
    made.update(options, 0, kPart);
    expect(bars.count).toBeLessThan(2 * (kLinks - 490));
    expect(bars.count).toBeGreaterThanOrEqual(2 * (kLinks - 501));
  });

  it('draws lines from afar, where joints are smaller than a pixel', () => {
    const { motion, made, copies, options, joint } = crowd();
    motion.setTime(0);
    made.update(options, 100 * joint, kEverything);
    expect(copies[0]!.visible).toBe(false);
    let lines: THREE.LineSegments | null = null;
    made.root.traverse((object) => {
      if (object instanceof THREE.LineSegments) lines = object;
    });
    expect(lines!.visible).toBe(true);
    const position = (lines! as THREE.LineSegments).geometry.getAttribute('position');
    expect([15, 31].map((v) => position.getX(v))).toEqual([3.5, 7.5]);
  });

  it('leaves joints that are few to their glyphs, and shows forces on demand', () => {
    const { motion, made, copies, options, joint } = crowd();
    expect(made.rest.joints.map(({ name }) => name)).toEqual(['pin_0']);
    expect(made.rest.bodies.size).toBe(0);
    motion.setTime(0);
    made.update({ ...options, reactions: true }, 0, kEverything);
    const arrows = copies.at(-2)!;
    expect(arrows.count).toBe(kLinks - 1); // nothing acts in the first one
    // The largest is twelve radii long and points along y.
    const at = placeOf(arrows, kLinks - 2, [0, 0, 1]);
    expect(at[0]).toBeCloseTo(kLinks - 1.5, 3);
    expect(at[1]).toBeCloseTo(12 * joint, 5);
  });

  it('names some of the parts, evenly spread', () => {
    const { motion, options, made } = crowd();
    const names = namesOf(motion, { joints: made.namedJoints(), loads: [] }, kLight, options);
    expect(names.length).toBe(2 * kLinks);
    expect(names.at(-1)!.text).toBe(`pin_${kLinks - 1}`);
    const some = spread(names, kMostNames);
    expect(some.length).toBeGreaterThan(kMostNames / 2);
    expect(some.length).toBeLessThanOrEqual(kMostNames);
    expect(some[0]).toBe(names[0]);
  });
});

describe('bounds of a crowd', () => {
  it('looks at the last frame', () => {
    const bounds = runBounds(decodeRun(chain(kLinks)));
    expect(bounds.center[1] + bounds.half[1]).toBeCloseTo(2.5, 5);
  });
});
