import { runBounds } from './bounds';
import { rotate } from './motion';
import { SwingingRows } from './rows';
import { PageDataError, type Body, type Run } from './run';
import { WholeShape } from './whole_shape';
import type { PageMode } from './page_data';

/** One vibration of the page. */
export interface Mode {
  /** "rod 3", "system 1". */
  label: string;
  /** [Hz]; 0 where the position is unstable. */
  frequency: number;
  /** Generalised mass of the shape with a largest displacement of 1 m [kg]. */
  mass: number;
}

/** The modes of the page's data. Throws PageDataError unless there is one per frame. */
export function checkModes(modes: PageMode[], run: Run): Mode[] {
  if (modes.length !== run.times.length) {
    throw new PageDataError(`modes: ${modes.length} found, ${run.times.length} expected`);
  }
  return modes.map(({ label, frequency, mass }) => ({
    label: label ?? '',
    frequency: frequency ?? 0,
    mass: mass ?? 0,
  }));
}

/** Pictures of one period. */
const kFrames = 65;

function phase(frame: number): number {
  return (2 * Math.PI * frame) / (kFrames - 1);
}

/** q · exp(w): a rotation vector in body axes after the quaternion w, x, y, z at `at` of q. */
function turned(q: ArrayLike<number>, at: number, w: number[]): number[] {
  const angle = Math.hypot(...w);
  const c = Math.cos(angle / 2);
  const s = angle > 0 ? Math.sin(angle / 2) / angle : 0;
  const [x, y, z] = rotate(q, at, [s * w[0]!, s * w[1]!, s * w[2]!]);
  const [qw, qx, qy, qz] = [q[at]!, q[at + 1]!, q[at + 2]!, q[at + 3]!];
  // (c, v) · q with v in world axes.
  return [
    c * qw - x * qx - y * qy - z * qz,
    c * qx + x * qw + y * qz - z * qy,
    c * qy - x * qz + y * qw + z * qx,
    c * qz + x * qy - y * qx + z * qw,
  ];
}

/** Turns the shape of a mode into a run of one period; the run object stays the same. */
export class ModeShapes {
  /** The run that the page plays. */
  readonly run: Run;
  index = 0;
  /** Largest displacement as a share of the model's size. */
  amplitude = 0.08;
  /** Length to which the amplitude refers [m]. */
  readonly size: number;
  /** Displacement relative to the shape's, for each picture. */
  private readonly factors = new Float64Array(kFrames);
  /** The same for an amplitude of one. */
  private readonly swing = Float64Array.from({ length: kFrames }, (_, k) => Math.sin(phase(k)));

  /** `shapes` holds one mode per frame; beside a `leader` they swing in phase with it. */
  constructor(
    private readonly shapes: Run,
    readonly modes: Mode[],
    private readonly leader: ModeShapes | null = null,
  ) {
    const still = shapes.bodies.map((body) => ({ ...body, displacement: null }));
    this.size = runBounds({ ...shapes, bodies: still }).size;
    this.run = {
      ...shapes,
      loads: [],
      times: leader?.run.times ?? new Float64Array(kFrames),
      joints: shapes.joints.map((joint) => ({ ...joint, force: null, torque: null })),
      bodies: shapes.bodies.map((body) => ({
        ...body,
        pose: new Float32Array(7 * kFrames),
        displacement: body.displacement && new SwingingRows(body.displacement, this.factors),
        shape: this.relative(body),
        fields: [],
      })),
    };
    this.show(0, this.amplitude);
  }

  /** Data for the colours: the shape, whatever the drawn amplitude. */
  private relative(body: Body): SwingingRows | null {
    const moves = body.displacement !== null || body.motion !== null;
    return moves && body.nodes.length > 0 ? new SwingingRows(new WholeShape(body), this.swing) : null;
  }

  get mode(): Mode {
    return this.modes[this.index]!;
  }

  /** Period of the mode shown [s]. */
  get period(): number {
    return this.mode.frequency > 0 ? 1 / this.mode.frequency : 1;
  }

  show(index: number, amplitude: number): void {
    this.index = Math.min(this.modes.length - 1, Math.max(0, index));
    this.amplitude = amplitude;
    for (const body of this.run.bodies) {
      for (const rows of [body.displacement, body.shape]) {
        if (rows instanceof SwingingRows) rows.choose(this.index);
      }
    }
    for (let k = 0; k < kFrames; k++) {
      if (!this.leader) this.run.times[k] = (this.period * k) / (kFrames - 1);
      this.factors[k] = amplitude * this.size * this.swing[k]!;
      this.turn(k, this.factors[k]!);
    }
  }

  /** Writes the poses of frame k with the shape times `factor`. */
  private turn(k: number, factor: number): void {
    const m = this.index;
    this.shapes.bodies.forEach((shape, b) => {
      const body = this.run.bodies[b]!;
      const move = (i: number) => factor * (shape.motion?.[6 * m + i] ?? 0);
      for (let i = 0; i < 3; i++) body.pose[7 * k + i] = shape.pose[7 * m + i]! + move(3 + i);
      body.pose.set(turned(shape.pose, 7 * m + 3, [move(0), move(1), move(2)]), 7 * k + 3);
    });
  }
}
