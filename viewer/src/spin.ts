import { cross, dot, perpendicular, subtract, unit } from './beam_curve';
import type { Body } from './run';
import type { Triple } from './page_data';

/** A body that turns by less than this in total [rad] needs no mark. */
const kLeastTurn = Math.PI / 2;
/** Largest radius over smallest, over the directions around an axis, of what looks round. */
const kRound = 1.12;
const kDirections = 16;
/** Number of frames examined. */
const kSampled = 400;

/** The axis about which a body turns that looks the same at every angle; body frame. */
export interface Spin {
  origin: Triple;
  axis: Triple;
  /** At right angles to the axis: where marks begin. */
  side: Triple;
}

/** Rotation vectors from frame to frame, in the axes of the body. */
function turns({ pose }: Body): Triple[] {
  const frames = pose.length / 7;
  const step = Math.max(1, Math.floor(frames / kSampled));
  const found: Triple[] = [];
  for (let k = 0; k + step < frames; k += step) {
    const [a, b] = [7 * k + 3, 7 * (k + step) + 3];
    const [w, x, y, z] = [pose[a]!, -pose[a + 1]!, -pose[a + 2]!, -pose[a + 3]!];
    const [p, q, r, s] = [pose[b]!, pose[b + 1]!, pose[b + 2]!, pose[b + 3]!];
    const v: Triple = [
      w * q + x * p + y * s - z * r,
      w * r - x * s + y * p + z * q,
      w * s + x * r - y * q + z * p,
    ];
    const scalar = w * p - x * q - y * r - z * s;
    const sine = Math.hypot(...v);
    const angle = 2 * Math.atan2(sine, Math.abs(scalar));
    if (!(sine > 0)) continue;
    const sign = scalar < 0 ? -1 : 1;
    found.push(v.map((c) => (sign * angle * c) / sine) as Triple);
  }
  return found;
}

/** The direction along which most of the vectors point, either way. */
function mainAxis(vectors: Triple[]): Triple | null {
  const sum = [0, 1, 2].map((i) => [0, 1, 2].map((k) => vectors.reduce((s, v) => s + v[i]! * v[k]!, 0)));
  let axis: Triple | null = null;
  for (const start of vectors.slice(0, 1)) axis = unit(start);
  for (let i = 0; axis && i < 50; i++) {
    const from: Triple = axis;
    const next = sum.map((row) => dot(row, from)) as Triple;
    if (!(Math.hypot(...next) > 0)) return null;
    axis = unit(next);
  }
  return axis;
}

/** Whether the nodes are as far out in every direction around the axis. */
function isRound(body: Body, { origin, axis, side }: Spin): boolean {
  const across = cross(axis, side);
  const most = new Float64Array(kDirections);
  let [largest, length] = [0, 0];
  for (let n = 0; n < body.nodes.length; n += 3) {
    const r = subtract(body.nodes.subarray(n, n + 3), origin);
    const [p, q] = [dot(r, side), dot(r, across)];
    const radius = Math.hypot(p, q);
    length = Math.max(length, Math.abs(dot(r, axis)));
    largest = Math.max(largest, radius);
    const turn = Math.atan2(q, p) / (2 * Math.PI) + 1;
    const direction = Math.round(turn * kDirections) % kDirections;
    most[direction] = Math.max(most[direction]!, radius);
  }
  // A straight shaft has its nodes on the axis.
  if (largest <= 1e-4 * length) return true;
  const seen = most.filter((radius) => radius > 0);
  return seen.length >= 6 && largest <= kRound * Math.min(...seen);
}

function middle(body: Body): Triple {
  const sum: Triple = [0, 0, 0];
  for (let i = 0; i < body.nodes.length; i++) sum[i % 3]! += body.nodes[i]!;
  return sum.map((x) => (3 * x) / body.nodes.length) as Triple;
}

/** Sections that look the same at every angle: circles have many corners. */
function hasRoundSections({ sections }: Body): boolean {
  return !sections || sections.loops.every(([outline]) => !outline || outline.length >= 16);
}

/** The spin of a body that its shape does not show; null if its shape shows it or it does not turn. */
export function spinOf(body: Body): Spin | null {
  const vectors = turns(body);
  const axis = mainAxis(vectors);
  if (!axis) return null;
  const total = vectors.reduce((sum, v) => sum + Math.abs(dot(v, axis)), 0);
  if (total < kLeastTurn) return null;
  const spin = { origin: [0, 0, 0] as Triple, axis, side: perpendicular(axis) };
  if (body.nodes.length === 0) {
    const off = body.markers.map(({ position }) => Math.hypot(...cross(axis, position)));
    const far = Math.max(0, ...body.markers.map(({ position }) => Math.hypot(...position)));
    return far > 0 && Math.max(...off) <= 1e-3 * far ? spin : null;
  }
  spin.origin = middle(body);
  return hasRoundSections(body) && isRound(body, spin) ? spin : null;
}

/** Coordinates of points across the axis, two each: their signs tell the quarters of a turn. */
export function quarters({ origin, axis, side }: Spin, points: Float32Array): Float32Array {
  const across = cross(axis, side);
  const out = new Float32Array((2 * points.length) / 3);
  for (let v = 0; 3 * v < points.length; v++) {
    const r = subtract(points.subarray(3 * v, 3 * v + 3), origin);
    out[2 * v] = dot(r, side);
    out[2 * v + 1] = dot(r, across);
  }
  return out;
}
