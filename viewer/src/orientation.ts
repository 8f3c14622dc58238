import { cross, dot, unit } from './beam_curve';
import type { Triple } from './page_data';
import type { Run } from './run';

/** Orientation of the world on the screen: which way is up, from where the camera first looks. */
export interface Orientation {
  up: Triple;
  /** From the target towards the camera. */
  back: Triple;
  /** Normal of the grid. */
  gridNormal: Triple;
}

const kNormal: Record<string, Triple> = { xy: [0, 0, 1], yz: [1, 0, 0], zx: [0, 1, 0] };
const kPlanarUp: Record<string, Triple> = { xy: [0, 1, 0], yz: [0, 0, 1], zx: [1, 0, 0] };

function minus(a: Triple): Triple {
  return [-a[0], -a[1], -a[2]];
}

/** A planar model is viewed along its normal, positive axes to the right; others from a corner. */
export function orientationOf(run: Pick<Run, 'gravity' | 'planar'>): Orientation {
  const falls = Math.hypot(...run.gravity) > 0;
  const skyward = falls ? minus(unit(run.gravity)) : null;
  if (run.planar) {
    const normal = kNormal[run.planar]!;
    const inPlane = skyward && Math.abs(dot(skyward, normal)) < 1e-6;
    const up = inPlane ? skyward : kPlanarUp[run.planar]!;
    const right = cross(up, normal);
    const back = right[0] + right[1] + right[2] >= 0 ? normal : minus(normal);
    return { up, back, gridNormal: normal };
  }
  const up: Triple = skyward ?? [0, 0, 1];
  // With z up the front is viewed from −y, with y up from +z: x then points to the right.
  const x: Triple = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const along = dot(x, up);
  const right = unit([x[0] - along * up[0], x[1] - along * up[1], x[2] - along * up[2]]);
  const front = cross(right, up);
  const back = [0, 1, 2].map((i) => 0.6 * right[i]! + front[i]! + 0.55 * up[i]!);
  return { up, back: unit(back), gridNormal: up };
}
