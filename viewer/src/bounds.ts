import { Motion } from './motion';
import { numNodes, type Run } from './run';
import { reachOf } from './shape_view';
import type { Triple } from './page_data';

export interface Bounds {
  center: Triple;
  /** Half edges of the box around everything over the whole run [m]. */
  half: Triple;
  /** Length that fills the view: diagonal over the whole run, never zero [m]. */
  size: number;
  /** Largest diagonal at any one time: the machine itself, however far it flies [m]. */
  machine: number;
}

class Box {
  low: Triple = [Infinity, Infinity, Infinity];
  high: Triple = [-Infinity, -Infinity, -Infinity];

  add(p: ArrayLike<number>): void {
    for (let i = 0; i < 3; i++) {
      if (!Number.isFinite(p[i])) continue;
      this.low[i] = Math.min(this.low[i]!, p[i]!);
      this.high[i] = Math.max(this.high[i]!, p[i]!);
    }
  }

  get diagonal(): number {
    const edges = this.low.map((low, i) => Math.max(0, this.high[i]! - low));
    return Math.hypot(...edges.map((edge) => (Number.isFinite(edge) ? edge : 0)));
  }
}

/** So many places of bodies and joints are looked at. */
const kLooks = 400_000;

/** Every so many-th number below `count`, and the last one. */
function everyOf(count: number, step: number): number[] {
  const numbers = [];
  for (let index = 0; index < count; index += step) numbers.push(index);
  if (count > 0 && numbers.at(-1) !== count - 1) numbers.push(count - 1);
  return numbers;
}

/** Box around all bodies and joints at about 200 of the stored frames, fewer if there are thousands of them. */
export function runBounds(run: Run): Bounds {
  const motion = new Motion(run);
  const whole = new Box();
  let machine = 0;
  const frames = run.times.length;
  const looks = Math.min(200, Math.max(10, Math.floor(kLooks / (run.bodies.length + run.joints.length + 1))));
  const step = Math.max(1, Math.floor(frames / looks));
  for (const index of everyOf(frames, step)) {
    motion.setPlace({ index, fraction: 0 });
    const now = new Box();
    const add = (p: Triple) => (now.add(p), whole.add(p));
    for (const body of motion.bodies) {
      add(body.toWorld([0, 0, 0]));
      const nodes = numNodes(body.body);
      const stride = Math.max(1, Math.floor(nodes / 50));
      for (let i = 0; i < nodes; i += stride) add(body.toWorld(body.node(i, 1)));
      if (nodes > 0) add(body.toWorld(body.node(nodes - 1, 1)));
      for (const marker of body.body.markers) add(body.toWorld(body.marker(marker, 1)));
    }
    for (const shape of run.shapes) {
      const reach = reachOf(shape);
      if (reach === 0) continue;
      const at = motion.side(shape.on, 1);
      for (const side of [-1, 1]) add(at.map((x) => x + side * reach) as Triple);
    }
    for (const cable of run.cables) {
      const axis = motion.axisOf(cable);
      cable.sides.forEach((side, k) => {
        const at = motion.side(side, 1);
        // A disc reaches as far along an edge of the box as it stands across it.
        for (const radius of [-cable.radii[k]!, cable.radii[k]!]) {
          add(at.map((x, i) => x + radius * Math.sqrt(Math.max(0, 1 - axis[i]! ** 2))) as Triple);
        }
      });
    }
    for (const joint of run.joints) for (const side of joint.between) add(motion.side(side, 1));
    machine = Math.max(machine, now.diagonal);
  }
  return boundsOf(whole, machine);
}

/** The box around both. */
export function joined(a: Bounds, b: Bounds): Bounds {
  const box = new Box();
  for (const { center, half } of [a, b]) {
    box.add(center.map((c, i) => c - half[i]!));
    box.add(center.map((c, i) => c + half[i]!));
  }
  return boundsOf(box, Math.max(a.machine, b.machine));
}

function boundsOf(whole: Box, machine: number): Bounds {
  const finite = whole.low.every(Number.isFinite) && whole.high.every(Number.isFinite);
  const center = finite ? whole.low.map((l, i) => (l + whole.high[i]!) / 2) : [0, 0, 0];
  const half = finite ? whole.low.map((l, i) => (whole.high[i]! - l) / 2) : [0, 0, 0];
  const distance = Math.hypot(...center);
  // A body without extent has no length of its own; nor is there one below float32's resolution.
  const resolvable = (length: number) => length > Math.max(1e-9, 1e-6 * distance);
  const diagonal = whole.diagonal;
  if (!resolvable(diagonal)) {
    return { center: center as Triple, half: half as Triple, size: 1, machine: 1 };
  }
  return {
    center: center as Triple,
    half: half as Triple,
    size: diagonal,
    machine: resolvable(machine) ? machine : diagonal / 4,
  };
}
