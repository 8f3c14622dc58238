import * as THREE from 'three';
import type { Bounds } from './bounds';
import type { BodyMotion } from './motion';
import type { SectionChoice } from './view_options';

const kAxes = { x: 0, y: 1, z: 2 } as const;

/** Least and largest undeformed coordinate of a body along each of its axes [m]. */
export function extent(motion: BodyMotion): [number, number][] {
  const { nodes } = motion.body;
  const ranges: [number, number][] = [0, 1, 2].map(() => [Infinity, -Infinity]);
  for (let i = 0; i < nodes.length; i++) {
    const range = ranges[i % 3]!;
    range[0] = Math.min(range[0], nodes[i]!);
    range[1] = Math.max(range[1], nodes[i]!);
  }
  return ranges.map(([low, high]) => (low <= high ? [low, high] : [0, 0]));
}

/** The cutting plane in scene units: the world shifted to the bounds' centre, over their size. */
export class Section {
  private readonly plane = new THREE.Plane();
  private readonly list = [this.plane];
  private readonly extents = new Map<BodyMotion, [number, number][]>();

  constructor(
    readonly bounds: Bounds,
    private readonly bodies: BodyMotion[],
  ) {}

  /** The only body that is cut; undefined for all, or if this run has none of that name. */
  private only(name: string): BodyMotion | undefined {
    return name ? this.bodies.find(({ body }) => body.name === name) : undefined;
  }

  /** Position of the plane: the coordinate along its axis in its frame [m]. */
  coordinate({ axis, body, fraction }: SectionChoice): number {
    if (axis === 'off') return 0;
    const k = kAxes[axis];
    const motion = this.only(body);
    if (!motion) return this.bounds.center[k] + (2 * fraction - 1) * this.bounds.half[k];
    let ranges = this.extents.get(motion);
    if (!ranges) this.extents.set(motion, (ranges = extent(motion)));
    const [low, high] = ranges[k]!;
    return low + fraction * (high - low);
  }

  /** The planes that cut the body with this index; null for none. */
  planes(choice: SectionChoice, body: number): THREE.Plane[] | null {
    if (choice.axis === 'off') return null;
    const { plane, bounds } = this;
    const motion = this.only(choice.body);
    if (choice.body && this.bodies[body] !== motion) return null;
    const k = kAxes[choice.axis];
    const normal = new THREE.Vector3().setComponent(k, choice.flip ? 1 : -1);
    const point = new THREE.Vector3().setComponent(k, this.coordinate(choice));
    if (motion) {
      const [px, py, pz, w, x, y, z] = motion.pose;
      const turn = new THREE.Quaternion(x, y, z, w);
      normal.applyQuaternion(turn);
      point.applyQuaternion(turn).add(new THREE.Vector3(px, py, pz));
    }
    point.sub(new THREE.Vector3(...bounds.center)).divideScalar(bounds.size);
    plane.setFromNormalAndCoplanarPoint(normal, point);
    return this.list;
  }
}
