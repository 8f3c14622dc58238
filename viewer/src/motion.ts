import { interpolatePose, interpolateRow, locate, type FramePlace } from './interpolation';
import type { Body, Run } from './run';
import type { PageJointSide, PageMarker, Triple } from './page_data';

/** v turned by the unit quaternion w, x, y, z at offset `at` of q. */
export function rotate(q: ArrayLike<number>, at: number, v: ArrayLike<number>): Triple {
  const [w, x, y, z] = [q[at]!, q[at + 1]!, q[at + 2]!, q[at + 3]!];
  const tx = 2 * (y * v[2]! - z * v[1]!);
  const ty = 2 * (z * v[0]! - x * v[2]!);
  const tz = 2 * (x * v[1]! - y * v[0]!);
  return [
    v[0]! + w * tx + y * tz - z * ty,
    v[1]! + w * ty + z * tx - x * tz,
    v[2]! + w * tz + x * ty - y * tx,
  ];
}

/** One body at the present time. */
export class BodyMotion {
  /** px, py, pz, qw, qx, qy, qz. */
  readonly pose: number[] = [0, 0, 0, 1, 0, 0, 0];
  /** nodes × 6, not magnified. */
  readonly displacement: Float32Array;
  readonly stress: Float32Array;
  /** Von Mises stress of the solid elements below the surface [Pa]. */
  readonly solidStress: Float32Array;

  constructor(readonly body: Body) {
    this.displacement = new Float32Array(6 * body.nodes.length);
    this.stress = new Float32Array(body.stress ? body.elements.length : 0);
    const solids = body.faceElements.reduce((most, e) => Math.max(most, e + 1), 0);
    this.solidStress = new Float32Array(body.solidStress ? solids : 0);
  }

  set(place: FramePlace): void {
    const { pose, displacement, stress, solidStress } = this.body;
    interpolatePose(pose, place, this.pose);
    if (displacement) {
      interpolateRow(displacement, this.displacement.length, place, this.displacement);
    }
    if (stress) interpolateRow(stress, this.stress.length, place, this.stress);
    if (solidStress) interpolateRow(solidStress, this.solidStress.length, place, this.solidStress);
  }

  /** A node in the body frame, displacement magnified by `scale`. */
  node(index: number, scale: number): Triple {
    const p = this.body.nodes[index]!;
    const d = 6 * index;
    return [0, 1, 2].map((i) => p[i]! + scale * this.displacement[d + i]!) as Triple;
  }

  /** A marker in the body frame: rigidly attached to its node. */
  marker(marker: PageMarker, scale: number): Triple {
    const origin = this.body.nodes[marker.node];
    if (!origin) return marker.position;
    const [x, y, z] = [0, 1, 2].map((i) => marker.position[i]! - origin[i]!) as Triple;
    const at = 6 * marker.node + 3;
    const [a, b, c] = [0, 1, 2].map((i) => scale * this.displacement[at + i]!) as Triple;
    const n = this.node(marker.node, scale);
    return [n[0] + x + b * z - c * y, n[1] + y + c * x - a * z, n[2] + z + a * y - b * x];
  }

  toWorld(p: ArrayLike<number>): Triple {
    const r = rotate(this.pose, 3, p);
    return [r[0] + this.pose[0]!, r[1] + this.pose[1]!, r[2] + this.pose[2]!];
  }
}

/** The whole run at one time. */
export class Motion {
  readonly bodies: BodyMotion[];
  place: FramePlace = { index: 0, fraction: 0 };

  constructor(readonly run: Run) {
    this.bodies = run.bodies.map((body) => new BodyMotion(body));
  }

  setTime(t: number): void {
    this.setPlace(locate(this.run.times, t));
  }

  setPlace(place: FramePlace): void {
    this.place = place;
    for (const body of this.bodies) body.set(place);
  }

  /** Over all elements at the present time [Pa]. */
  get largestStress(): number {
    let most = 0;
    for (const body of this.bodies) {
      for (const s of body.stress) most = s > most ? s : most;
      for (const s of body.solidStress) most = s > most ? s : most;
    }
    return most;
  }

  /** World position of one side of a joint. */
  side(side: PageJointSide, scale: number): Triple {
    const motion = this.bodies[side.body];
    if (!motion) return [...side.position];
    const marker = motion.body.markers[side.marker];
    return motion.toWorld(marker ? motion.marker(marker, scale) : side.position);
  }
}
