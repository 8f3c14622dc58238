import type { Triple } from './page_data';

export function subtract(a: ArrayLike<number>, b: ArrayLike<number>): Triple {
  return [a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!];
}

export function cross(a: ArrayLike<number>, b: ArrayLike<number>): Triple {
  return [
    a[1]! * b[2]! - a[2]! * b[1]!,
    a[2]! * b[0]! - a[0]! * b[2]!,
    a[0]! * b[1]! - a[1]! * b[0]!,
  ];
}

export function dot(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
}

export function unit(a: ArrayLike<number>): Triple {
  const length = Math.hypot(a[0]!, a[1]!, a[2]!) || 1;
  return [a[0]! / length, a[1]! / length, a[2]! / length];
}

/** Any unit vector at right angles to the unit vector e. */
export function perpendicular(e: Triple): Triple {
  const [x, y, z] = e.map(Math.abs) as Triple;
  const least: Triple = z <= x && z <= y ? [0, 0, 1] : y <= x ? [0, 1, 0] : [1, 0, 0];
  const along = dot(least, e);
  return unit([least[0] - along * e[0], least[1] - along * e[1], least[2] - along * e[2]]);
}

/**
 * Centre line of one two-node element: axial displacement linear, transverse displacement the cubic
 * Hermite polynomial of nodal displacements and rotations, i.e. the element's own shape functions.
 * `scale` magnifies displacements and rotations alike. Bars (no rotations) stay straight.
 */
export class BeamCurve {
  readonly point: Triple = [0, 0, 0];
  /** dx/dξ, not normalised. */
  readonly tangent: Triple = [0, 0, 0];
  readonly axis: Triple;
  readonly length: number;
  private readonly ends = new Float64Array(6);
  private readonly slopes = new Float64Array(6);

  constructor(
    private readonly start: Triple,
    private readonly end: Triple,
    private readonly hasRotations: boolean,
  ) {
    const span = subtract(end, start);
    this.length = Math.hypot(...span);
    this.axis = unit(span);
  }

  /** Takes the nodal values: six numbers at offsets a and b of `d`. */
  deform(d: ArrayLike<number>, a: number, b: number, scale: number): void {
    const e = this.axis;
    const ends = this.ends;
    for (let i = 0; i < 3; i++) {
      ends[i] = this.start[i]! + scale * d[a + i]!;
      ends[3 + i] = this.end[i]! + scale * d[b + i]!;
    }
    if (!this.hasRotations) {
      for (let i = 0; i < 3; i++) this.slopes[i] = this.slopes[3 + i] = ends[3 + i]! - ends[i]!;
      return;
    }
    let stretch = 0;
    for (let i = 0; i < 3; i++) stretch += (ends[3 + i]! - ends[i]!) * e[i]!;
    this.slope(d, a + 3, scale, stretch, 0);
    this.slope(d, b + 3, scale, stretch, 3);
  }

  private slope(
    d: ArrayLike<number>,
    at: number,
    scale: number,
    stretch: number,
    to: number,
  ): void {
    const e = this.axis;
    const [x, y, z] = [d[at]! * scale, d[at + 1]! * scale, d[at + 2]! * scale];
    this.slopes[to] = e[0] * stretch + this.length * (y * e[2] - z * e[1]);
    this.slopes[to + 1] = e[1] * stretch + this.length * (z * e[0] - x * e[2]);
    this.slopes[to + 2] = e[2] * stretch + this.length * (x * e[1] - y * e[0]);
  }

  /** Fills `point` and `tangent` at ξ in [0, 1]. */
  at(xi: number): void {
    const s = xi * xi;
    const c = s * xi;
    for (let i = 0; i < 3; i++) {
      const [p, q] = [this.ends[i]!, this.ends[3 + i]!];
      const [u, v] = [this.slopes[i]!, this.slopes[3 + i]!];
      this.point[i] =
        (1 - 3 * s + 2 * c) * p + (3 * s - 2 * c) * q + (xi - 2 * s + c) * u + (c - s) * v;
      this.tangent[i] =
        6 * (s - xi) * p + 6 * (xi - s) * q + (1 - 4 * xi + 3 * s) * u + (3 * s - 2 * xi) * v;
    }
  }
}
