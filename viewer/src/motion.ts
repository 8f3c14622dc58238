import { interpolatePose, locate, type FramePlace } from './interpolation';
import { nodeAt, numNodes, type Body, type Cable, type Run } from './run';
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

/** One body at the current time. */
export class BodyMotion {
  /** px, py, pz, qw, qx, qy, qz. */
  readonly pose: number[] = [0, 0, 0, 1, 0, 0, 0];
  private place: FramePlace = { index: 0, fraction: 0 };
  private readonly row: Float32Array;
  private stale: boolean;

  constructor(readonly body: Body) {
    this.row = new Float32Array(body.perNode * numNodes(body));
    this.stale = body.displacement !== null;
  }

  set(place: FramePlace): void {
    this.place = place;
    this.stale = this.body.displacement !== null;
    interpolatePose(this.body.pose, place, this.pose);
  }

  /** Nodes × `perNode`, not magnified; computed on request. */
  get displacement(): Float32Array {
    if (this.stale) this.body.displacement!.interpolate(this.place, this.row);
    this.stale = false;
    return this.row;
  }

  /** One number of `displacement`, without computing the others. */
  private moved(index: number): number {
    const rows = this.body.displacement;
    if (!rows || !this.stale) return this.row[index]!;
    const { index: frame, fraction } = this.place;
    const now = rows.value(frame, index);
    return fraction === 0 ? now : now * (1 - fraction) + rows.value(frame + 1, index) * fraction;
  }

  /** A node in the body frame, displacement magnified by `scale`. */
  node(index: number, scale: number): Triple {
    const { nodes, perNode } = this.body;
    const at = (k: number) => nodes[3 * index + k]! + scale * this.moved(perNode * index + k);
    return [at(0), at(1), at(2)];
  }

  /** A marker in the body frame: rigidly attached to its node. */
  marker(marker: PageMarker, scale: number): Triple {
    const { body } = this;
    if (marker.node < 0 || marker.node >= numNodes(body)) return marker.position;
    const origin = nodeAt(body, marker.node);
    const [x, y, z] = [0, 1, 2].map((i) => marker.position[i]! - origin[i]!) as Triple;
    const n = this.node(marker.node, scale);
    if (body.perNode === 3) return [n[0] + x, n[1] + y, n[2] + z];
    const at = 6 * marker.node + 3;
    const [a, b, c] = [0, 1, 2].map((i) => scale * this.moved(at + i)) as Triple;
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

  /** World position of one side of a joint. */
  side(side: PageJointSide, scale: number): Triple {
    const motion = this.bodies[side.body];
    if (!motion) return [...side.position];
    const marker = motion.body.markers[side.marker];
    return motion.toWorld(marker ? motion.marker(marker, scale) : side.position);
  }

  /** Axis of the pulleys of a cable, in the world. */
  axisOf(cable: Cable): Triple {
    const first = this.bodies[cable.sides[cable.firstPulley]!.body];
    return first ? rotate(first.pose, 3, cable.axis) : cable.axis;
  }
}
