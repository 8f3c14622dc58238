import * as THREE from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { Copies, kFrame, putPlace } from './copies';
import { kZ } from './glyphs';
import { interpolateRow } from './interpolation';
import { kLeast, kLength, kReactionColor, type LargestReactions } from './reaction_view';
import type { Motion } from './motion';
import type { Joint } from './run';

/** An arrow of unit length along z, with a ring that turns about it for torques. */
function arrowForm(turns: boolean): THREE.BufferGeometry {
  const shaft = new THREE.CylinderGeometry(0.035, 0.035, 0.75, 5, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.375);
  const head = new THREE.ConeGeometry(0.105, 0.27, 6).rotateX(Math.PI / 2).translate(0, 0, 0.865);
  const ring = new THREE.TorusGeometry(0.3, 0.035, 4, 12, 1.6 * Math.PI).translate(0, 0, 0.4);
  return mergeGeometries(turns ? [shaft, head, ring] : [shaft, head]);
}

/** Forces and torques of thousands of joints as arrows. */
export class ReactionCrowd {
  readonly root = new THREE.Group();
  private readonly kinds: { copies: Copies; values: 'force' | 'torque'; frames: Float32Array }[] = [];
  private readonly row: number[] = [];
  /** Joints at which something acts. */
  private readonly seen: Uint8Array;

  constructor(
    private readonly motion: Motion,
    private readonly joints: Joint[],
    private readonly largest: LargestReactions,
  ) {
    this.seen = new Uint8Array(joints.length);
    const owners = Int32Array.from(joints.keys());
    const whole = new Float32Array(kFrame * joints.length);
    for (let i = 0; i < joints.length; i++) whole.set([1, 0, 0, 0, 1, 0, 0, 0, 1], kFrame * i);
    for (const values of ['force', 'torque'] as const) {
      const copies = new Copies(arrowForm(values === 'torque'), { owners, frames: whole }, kReactionColor);
      this.kinds.push({ copies, values, frames: new Float32Array(kFrame * joints.length) });
      this.root.add(copies.mesh);
    }
  }

  /** @param joint radius of joints [m] */
  update(joint: number): void {
    const [v, at, turn] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Quaternion()];
    const stretch = new THREE.Vector3();
    for (const { copies, values, frames } of this.kinds) {
      const largest = this.largest[values];
      copies.mesh.visible = largest > 0;
      if (!copies.mesh.visible) continue;
      this.seen.fill(0);
      this.joints.forEach((one, j) => {
        const all = one[values];
        if (!all) return;
        interpolateRow(all, 3, this.motion.place, this.row);
        const size = v.set(this.row[0]!, this.row[1]!, this.row[2]!).length();
        if (!(size > kLeast * largest)) return;
        at.set(...this.motion.side(one.between.at(-1)!, 1));
        turn.setFromUnitVectors(kZ, v.divideScalar(size));
        stretch.setScalar(kLength * joint * Math.sqrt(Math.min(1, size / largest)));
        putPlace(at, turn, stretch, frames, j);
        this.seen[j] = 1;
      });
      copies.update(frames, this.seen);
    }
  }

  dispose(): void {
    for (const { copies } of this.kinds) copies.dispose();
  }
}
