import { BeamCurve, cross, dot, perpendicular, unit } from './beam_curve';
import { circle, profileOf, type Profile } from './section_profile';
import { nodeEnds, outwards, type End } from './tube_ends';
import { nodeAt, type Body } from './run';
import type { Triple } from './page_data';

/** Maximum number of vertices of one body; large models get coarser beams instead of a slow page. */
const kVertexBudget = 60000;

interface Cap {
  element: number;
  atEnd: boolean;
  firstVertex: number;
}

/** The direction in which a beam continues as another, and how their bend is mitred. */
interface Mitre {
  /** Midway between the directions of both. */
  mean: Triple;
  /** Unit vector in the plane of the bend, at right angles to `mean`. */
  across: Triple;
  /** Ratio of the length of the cut along `across` to the width of the section. */
  stretch: number;
}

/** Beams that meet at a larger angle have an edge between them: 1/cos 20° − 1. */
const kSharp = 0.064;

/** Vertices swept along one element. */
interface Sweep {
  first: number;
  profiles: [Profile, Profile];
  /** Magnification of the profiles, which keeps thin beams visible. */
  scales: [number, number];
}

/** v turned by the rotation vector w. */
function turnedBy(v: Triple, w: Triple): Triple {
  const angle = Math.hypot(...w);
  if (angle < 1e-12) return v;
  const e = unit(w);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [x, along] = [cross(e, v), (1 - c) * dot(e, v)];
  return [0, 1, 2].map((k) => c * v[k]! + s * x[k]! + along * e[k]!) as Triple;
}

/** The part of v at right angles to the unit vector t, as a unit vector. */
function across(v: Triple, t: Triple): Triple {
  const along = dot(v, t);
  return unit([v[0] - along * t[0], v[1] - along * t[1], v[2] - along * t[2]]);
}

/**
 * Triangles that draw the beams of a body, their sections swept along the elements' own shape; the
 * topology is fixed, vertices follow the nodes.
 */
export class Tube {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: number[] = [];
  /** Element of each vertex, for colours. */
  readonly elementOf: Int32Array;
  /** Position of each vertex along its element, 0 … 1. */
  readonly alongOf: Float32Array;
  /** Nodes with a sharp bend or a branch, where a ball closes the gap between beams. */
  readonly kinks: number[];
  /** At both ends of each element: radius of the largest circle inside the section. */
  readonly inside: [number, number][];
  private readonly joins: [End, End][];
  /** For each end, null if nothing is joined. */
  private readonly mitres: (Mitre | null)[];
  private readonly curves: BeamCurve[];
  /** Local y axis of each element. */
  private readonly axes: Triple[];
  private readonly sweeps: Sweep[] = [];
  private readonly caps: Cap[] = [];
  private readonly segments: number;
  /** Nodal rotations at both ends of the current element, magnified. */
  private readonly turns: [Triple, Triple] = [
    [0, 0, 0],
    [0, 0, 0],
  ];

  /** `leastRadius` keeps thin beams visible [m]. */
  constructor(
    private readonly body: Body,
    leastRadius: number,
  ) {
    const count = body.elements.length;
    this.curves = body.elements.map(
      ([a, b]) => new BeamCurve(nodeAt(body, a), nodeAt(body, b), body.hasRotations),
    );
    this.axes = this.curves.map((curve, e) => this.axis(curve, e));
    const share = kVertexBudget / Math.max(1, count);
    const sides = share > 150 ? 16 : share > 40 ? 10 : 6;
    const profiles = this.profiles(leastRadius, sides);
    const curved = body.displacement !== null && body.hasRotations;
    const around = Math.max(...profiles.map(({ profiles: [a] }) => a.points.length), sides);
    const most = Math.max(1, Math.floor(share / around) - 1);
    this.segments = curved ? Math.min(most, count > 40 ? 4 : 10) : 1;
    this.inside = profiles.map(({ profiles: ends, scales }) => [
      ends[0].inside * scales[0],
      ends[1].inside * scales[1],
    ]);

    const { open, kinks, joins } = nodeEnds(body, this.curves);
    [this.kinks, this.joins] = [kinks, joins];
    this.mitres = new Array<Mitre | null>(2 * count).fill(null);
    let vertices = 0;
    for (const sweep of profiles) {
      this.sweeps.push({ ...sweep, first: vertices });
      vertices += (this.segments + 1) * sweep.profiles[0].points.length;
    }
    body.elements.forEach(([a, b], element) => {
      for (const atEnd of [false, true]) {
        if (!open.has(atEnd ? b : a)) continue;
        this.caps.push({ element, atEnd, firstVertex: vertices });
        vertices += profiles[element]!.profiles[0].points.length;
      }
    });
    this.positions = new Float32Array(3 * vertices);
    this.normals = new Float32Array(3 * vertices);
    this.elementOf = new Int32Array(vertices);
    this.alongOf = new Float32Array(vertices);
    this.connect();
  }

  /** The recorded local y axis, made perpendicular to the element; any perpendicular if there is none. */
  private axis(curve: BeamCurve, element: number): Triple {
    const { sections } = this.body;
    if (!sections) return perpendicular(curve.axis);
    const y = sections.axes.subarray(3 * element, 3 * element + 3);
    const along = dot(y, curve.axis);
    const across = [0, 1, 2].map((k) => y[k]! - along * curve.axis[k]!) as Triple;
    return Math.hypot(...across) > 1e-3 ? unit(across) : perpendicular(curve.axis);
  }

  private profiles(leastRadius: number, sides: number): Omit<Sweep, 'first'>[] {
    const { sections, radius, elements } = this.body;
    const round = profileOf([circle(1, sides)], 1, true);
    const known = sections?.loops.map((loops) => profileOf(loops, sides < 10 ? 3 : sides < 16 ? 2 : 1));
    const scale = (own: Profile, r: number) =>
      own === round ? Math.max(r, leastRadius) : Math.max(1, leastRadius / (own.radius || 1));
    return elements.map((_, e) => {
      const ends = [0, 1].map((end) => {
        const own = known?.[sections!.at[2 * e + end]!];
        return own && own.sides.length >= 3 ? own : round;
      });
      const alike = ends[0]!.points.length === ends[1]!.points.length;
      const profiles: [Profile, Profile] = [ends[0]!, alike ? ends[1]! : ends[0]!];
      return {
        profiles,
        scales: [scale(profiles[0], radius[e]![0]), scale(profiles[1], radius[e]![1])],
      };
    });
  }

  private connect(): void {
    this.sweeps.forEach(({ first, profiles: [{ points, sides }] }, e) => {
      const n = points.length;
      this.elementOf.fill(e, first, first + (this.segments + 1) * n);
      for (let s = 0; s < this.segments; s++) {
        const a = first + s * n;
        this.alongOf.fill((s + 1) / this.segments, a + n, a + 2 * n);
        for (const [i, j] of sides) {
          this.indices.push(a + i, a + j, a + n + i, a + j, a + n + j, a + n + i);
        }
      }
    });
    for (const { element, atEnd, firstVertex } of this.caps) {
      const { points, cap } = this.sweeps[element]!.profiles[0];
      this.elementOf.fill(element, firstVertex, firstVertex + points.length);
      this.alongOf.fill(atEnd ? 1 : 0, firstVertex, firstVertex + points.length);
      for (const [i, j, k] of cap) {
        this.indices.push(firstVertex + i, firstVertex + (atEnd ? j : k));
        this.indices.push(firstVertex + (atEnd ? k : j));
      }
    }
  }

  /** Moves the vertices to the nodal values d (nodes × 6) magnified by `scale`. */
  deform(d: ArrayLike<number>, scale: number): void {
    const { elements, hasRotations } = this.body;
    elements.forEach(([a, b], e) => this.curves[e]!.deform(d, 6 * a, 6 * b, scale));
    for (const [a, b] of this.joins) this.mitre(a, b);
    const turn = (to: Triple, node: number) => {
      for (let k = 0; k < 3; k++) to[k] = hasRotations ? scale * d[6 * node + 3 + k]! : 0;
    };
    let cap = 0;
    this.sweeps.forEach(({ first, profiles: [{ points }] }, e) => {
      turn(this.turns[0], elements[e]![0]);
      turn(this.turns[1], elements[e]![1]);
      for (let s = 0; s <= this.segments; s++) {
        this.ring(first + s * points.length, e, s / this.segments, 0);
      }
      for (; this.caps[cap]?.element === e; cap++) {
        const { atEnd, firstVertex } = this.caps[cap]!;
        this.ring(firstVertex, e, atEnd ? 1 : 0, atEnd ? 1 : -1);
      }
    });
  }

  private mitre(a: End, b: End): void {
    const [out, into] = [a, b].map((end) => {
      const curve = this.curves[end >> 1]!;
      curve.at(end % 2);
      return unit(curve.tangent);
    }) as [Triple, Triple];
    const turn = -outwards(a) * outwards(b);
    const mean = unit(out.map((x, k) => x + turn * into[k]!) as Triple);
    const half = dot(out, mean);
    const sideways = across(out, mean);
    // A magnified deformation may fold beams back: the mitre must stay bounded then.
    const stretch = 1 / Math.max(0.4, half) - 1;
    this.mitres[a] = { mean, across: sideways, stretch };
    this.mitres[b] = { mean: mean.map((x) => turn * x) as Triple, across: sideways, stretch };
  }

  /** Writes one ring around the curve at ξ in [0, 1]; `capSign` ≠ 0 makes it the rim of a cap. */
  private ring(first: number, element: number, xi: number, capSign: number): void {
    const curve = this.curves[element]!;
    curve.at(xi);
    const { point, tangent } = curve;
    const { profiles, scales } = this.sweeps[element]!;
    const mitre = this.mitres[xi === 0 ? 2 * element : xi === 1 ? 2 * element + 1 : -1];
    const t = mitre?.mean ?? unit(tangent);
    const turns = this.turns;
    const w = [0, 1, 2].map((k) => (1 - xi) * turns[0][k]! + xi * turns[1][k]!) as Triple;
    const y = turnedBy(this.axes[element]!, w);
    const u = across(y, t);
    const v = cross(t, u);
    // A side of a sharp corner is lit like the rest of it.
    const sharp = mitre !== null && mitre !== undefined && mitre.stretch > kSharp;
    const straight = sharp ? unit(tangent) : t;
    const [nu, nv] = sharp ? [across(y, straight), cross(straight, across(y, straight))] : [u, v];
    const { positions, normals } = this;
    const [{ points, normals: flat }, { points: last }] = profiles;
    const [p, q] = [(1 - xi) * scales[0], xi * scales[1]];
    for (let i = 0; i < points.length; i++) {
      const [a, b] = [points[i]!, last[i]!];
      const [m, n] = flat[i]!;
      const [py, pz] = [p * a[0] + q * b[0], p * a[1] + q * b[1]];
      // The normals of a taper tilt towards its thin end.
      const grown = m * (scales[1] * b[0] - scales[0] * a[0]) + n * (scales[1] * b[1] - scales[0] * a[1]);
      const lean = -grown / (curve.length || 1);
      const norm = Math.hypot(1, lean);
      const wide = mitre
        ? mitre.stretch * (py * dot(u, mitre.across) + pz * dot(v, mitre.across))
        : 0;
      for (let k = 0; k < 3; k++) {
        const at = 3 * (first + i) + k;
        positions[at] = point[k]! + py * u[k]! + pz * v[k]! + wide * (mitre?.across[k] ?? 0);
        const side = m * nu[k]! + n * nv[k]! + lean * straight[k]!;
        normals[at] = capSign === 0 ? side / norm : capSign * t[k]!;
      }
    }
  }
}
