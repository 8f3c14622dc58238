import * as THREE from 'three';
import { Copies, kFrame, putPlace } from './copies';
import { kZ } from './glyphs';
import { rotate, type Motion } from './motion';
import type { Joint } from './run';
import type { Theme } from './theme';

/** Types whose axis is seen. */
const kAxial = ['revolute', 'hinge', 'cylindrical', 'prismatic', 'screw', 'universal'];
/** Drawn by the line between their sides alone. */
const kLines = ['spring', 'distance'];

type Form = 'axial' | 'round' | 'line';

function formOf(joint: Joint): Form {
  const type = joint.type.toLowerCase();
  if (kLines.some((name) => type.includes(name))) return 'line';
  return kAxial.includes(type) ? 'axial' : 'round';
}

function geometryOf(form: Form): THREE.BufferGeometry {
  if (form === 'axial') return new THREE.CylinderGeometry(1, 1, 2.2, 6).rotateX(Math.PI / 2);
  return new THREE.OctahedronGeometry(1.1, 1);
}

/** Joints by the thousand: a short cylinder along the axis, or a ball, and a line where the sides are apart. */
export class JointCrowd {
  readonly root = new THREE.Group();
  private readonly frames: Float32Array;
  private readonly spans: Float32Array;
  private readonly glyphs: Copies[] = [];
  private readonly lines: Copies;
  private readonly seen: Uint8Array;
  private readonly all: Uint8Array;
  private readonly one = new THREE.Vector3(1, 1, 1);

  constructor(
    private readonly motion: Motion,
    private readonly joints: Joint[],
    theme: Theme,
  ) {
    this.frames = new Float32Array(kFrame * joints.length);
    this.spans = new Float32Array(kFrame * joints.length);
    this.seen = new Uint8Array(joints.length);
    this.all = new Uint8Array(joints.length).fill(1);
    for (const form of ['axial', 'round'] as const) {
      const owners = Int32Array.from([...joints.keys()].filter((j) => formOf(joints[j]!) === form));
      if (owners.length === 0) continue;
      this.add(new Copies(geometryOf(form), { owners, frames: new Float32Array(0) }, theme.joint), this.glyphs);
    }
    const all = Int32Array.from(joints.keys());
    const line = new THREE.CylinderGeometry(1, 1, 1, 5, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.lines = new Copies(line, { owners: all, frames: new Float32Array(0) }, theme.muted);
    this.root.add(this.lines.mesh);
  }

  private add(copies: Copies, to: Copies[]): void {
    to.push(copies);
    this.root.add(copies.mesh);
  }

  /** @param joint radius of joints [m] */
  update(joint: number, picture: THREE.Frustum): void {
    const [along, turn] = [new THREE.Vector3(), new THREE.Quaternion()];
    const [a, b, stretch] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    const { motion } = this;
    let apart = 0;
    this.joints.forEach(({ between, axis }, j) => {
      const first = motion.bodies[between[0]!.body];
      a.set(...motion.side(between[0]!, 1));
      b.set(...motion.side(between.at(-1)!, 1));
      along.set(...(first ? rotate(first.pose, 3, axis) : axis));
      turn.identity();
      if (along.lengthSq() > 0) turn.setFromUnitVectors(kZ, along.normalize());
      putPlace(b, turn, this.one, this.frames, j);
      this.seen[j] = picture.containsPoint(b) || picture.containsPoint(a) ? 1 : 0;
      const length = along.subVectors(b, a).length();
      const isApart = length > 0.2 * joint;
      if (isApart) {
        apart++;
        turn.setFromUnitVectors(kZ, along.divideScalar(length));
      }
      putPlace(a, turn, stretch.set(1, 1, isApart ? length : 0), this.spans, j);
      // What has no length is not drawn.
      if (!isApart) this.spans.fill(0, kFrame * j, kFrame * j + 9);
    });
    for (const copies of this.glyphs) {
      copies.place(uniform(copies.size, [joint, joint, joint]));
      copies.update(this.frames, this.seen);
    }
    this.lines.mesh.visible = apart > 0;
    if (apart === 0) return;
    this.lines.place(uniform(this.joints.length, [0.15 * joint, 0.15 * joint, 1]));
    this.lines.update(this.spans, this.all);
  }

  dispose(): void {
    for (const copies of [...this.glyphs, this.lines]) copies.dispose();
  }
}

/** The same stretch for all. */
export function uniform(count: number, [x, y, z]: [number, number, number]): Float32Array {
  const out = new Float32Array(kFrame * count);
  for (let i = 0; i < count; i++) {
    out[kFrame * i] = x;
    out[kFrame * i + 4] = y;
    out[kFrame * i + 8] = z;
  }
  return out;
}
