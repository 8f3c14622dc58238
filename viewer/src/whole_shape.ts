import { rotate } from './motion';
import { rangeOf, type Rows } from './rows';
import type { FramePlace } from './interpolation';
import type { Body } from './run';
import type { Triple } from './page_data';

/**
 * Displacements of the nodes of a body in a vibration, body axes: the motion of its frame and that of
 * the nodes within it. The largest of the whole model is one. A row per vibration, nodes × 3.
 */
export class WholeShape implements Rows {
  readonly width: number;
  readonly frames: number;
  private readonly row: Float32Array;

  constructor(private readonly body: Body) {
    this.width = body.nodes.length;
    this.frames = body.pose.length / 7;
    this.row = new Float32Array((body.perNode * body.nodes.length) / 3);
  }

  /** Shapes do not mix: the one at the frame. */
  interpolate({ index }: FramePlace, out: Float32Array): void {
    const { displacement, motion, nodes, pose, perNode } = this.body;
    if (displacement) displacement.interpolate({ index, fraction: 0 }, this.row);
    const moved = (i: number) => motion?.[6 * index + i] ?? 0;
    const [wx, wy, wz] = [moved(0), moved(1), moved(2)];
    const at = 7 * index + 3;
    const back = [pose[at]!, -pose[at + 1]!, -pose[at + 2]!, -pose[at + 3]!];
    const [tx, ty, tz]: Triple = rotate(back, 0, [moved(3), moved(4), moved(5)]);
    for (let n = 0, d = 0; n < nodes.length; n += 3, d += perNode) {
      const [x, y, z] = [nodes[n]!, nodes[n + 1]!, nodes[n + 2]!];
      out[n] = tx + wy * z - wz * y + this.row[d]!;
      out[n + 1] = ty + wz * x - wx * z + this.row[d + 1]!;
      out[n + 2] = tz + wx * y - wy * x + this.row[d + 2]!;
    }
  }

  value(frame: number, index: number): number {
    const out = new Float32Array(this.width);
    this.interpolate({ index: frame, fraction: 0 }, out);
    return out[index]!;
  }

  range(frame: number): [number, number] {
    const out = new Float32Array(this.width);
    this.interpolate({ index: frame, fraction: 0 }, out);
    return rangeOf(out);
  }
}
