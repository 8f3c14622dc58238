import { BeamCurve, cross, dot, perpendicular, unit } from './beam_curve';
import { nodeAt, type Body } from './run';
import type { Triple } from './page_data';

/** Vertices that one body may spend; long models get coarser tubes instead of a slow page. */
const kVertexBudget = 60000;

/** Radii that differ by more than this share make a step. */
const kStep = 1e-6;
/** Up to this bend two tubes are mitred, beyond it a ball closes the gap: cos 60°. */
const kMitred = 0.5;

interface Cap {
  element: number;
  atEnd: boolean;
  firstVertex: number;
}

/** An end of an element: 2 · element for the first, one more for the second. */
type End = number;

/** Out of the element at this end. */
function outwards(end: End): number {
  return end % 2 ? 1 : -1;
}

interface NodeEnds {
  /** Nodes at which tubes end or change their radius. */
  open: Set<number>;
  /** Nodes with a branch or a sharp bend. */
  kinks: number[];
  /** Pairs of ends at which one tube goes on as the other. */
  joins: [End, End][];
}

function nodeEnds(body: Body, curves: BeamCurve[]): NodeEnds {
  const at = new Map<number, End[]>();
  body.elements.forEach((nodes, e) => {
    nodes.forEach((node, k) => {
      const known = at.get(node);
      if (known) known.push(2 * e + k);
      else at.set(node, [2 * e + k]);
    });
  });
  const found: NodeEnds = { open: new Set(), kinks: [], joins: [] };
  for (const [node, ends] of at) {
    const radii = ends.map((end) => body.radius[end >> 1]![end % 2]!);
    const least = Math.min(...radii);
    if (ends.length === 1 || Math.max(...radii) - least > kStep * least) found.open.add(node);
    if (ends.length === 1) continue;
    const [a, b] = [ends[0]!, ends[1]!];
    const along = dot(curves[a >> 1]!.axis, curves[b >> 1]!.axis);
    const straight = -outwards(a) * outwards(b) * along;
    if (ends.length === 2 && straight > kMitred) found.joins.push([a, b]);
    else found.kinks.push(node);
  }
  return found;
}

/** Triangles of the tubes that draw a beam body; the topology is fixed, vertices follow the nodes. */
export class Tube {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: number[] = [];
  /** Element of each vertex, for colours. */
  readonly elementOf: Int32Array;
  /** Where each vertex is along its element, 0 … 1. */
  readonly alongOf: Float32Array;
  /** Nodes with a sharp bend or a branch, where a ball closes the gap between tubes. */
  readonly kinks: number[];
  private readonly joins: [End, End][];
  /** By end: direction of the tube there, midway between two tubes that are joined. */
  private readonly mitres: (Triple | null)[];
  /** At both ends of each element. */
  readonly radius: [number, number][];
  private readonly curves: BeamCurve[];
  private readonly reference: Triple[];
  private readonly caps: Cap[] = [];
  private readonly sides: number;
  /** Cosine and sine of each side. */
  private readonly circle: Float64Array;
  private readonly segments: number;

  /** `leastRadius` keeps thin beams visible [m]. */
  constructor(
    private readonly body: Body,
    leastRadius: number,
  ) {
    const count = body.elements.length;
    this.curves = body.elements.map(
      ([a, b]) => new BeamCurve(nodeAt(body, a), nodeAt(body, b), body.hasRotations),
    );
    this.reference = this.curves.map((curve) => perpendicular(curve.axis));
    this.radius = body.radius.map(([a, b]) => [Math.max(a, leastRadius), Math.max(b, leastRadius)]);
    const share = kVertexBudget / Math.max(1, count);
    this.sides = share > 150 ? 16 : share > 40 ? 10 : 6;
    this.circle = new Float64Array(2 * this.sides).map((_, i) => {
      const angle = (2 * Math.PI * (i >> 1)) / this.sides;
      return i % 2 ? Math.sin(angle) : Math.cos(angle);
    });
    const curved = body.displacement !== null && body.hasRotations;
    const most = Math.max(1, Math.floor(share / this.sides) - 1);
    this.segments = curved ? Math.min(most, count > 40 ? 4 : 10) : 1;

    const { open, kinks, joins } = nodeEnds(body, this.curves);
    [this.kinks, this.joins] = [kinks, joins];
    this.mitres = new Array<Triple | null>(2 * count).fill(null);
    let vertices = count * (this.segments + 1) * this.sides;
    body.elements.forEach(([a, b], element) => {
      for (const atEnd of [false, true]) {
        if (!open.has(atEnd ? b : a)) continue;
        this.caps.push({ element, atEnd, firstVertex: vertices });
        vertices += this.sides + 1;
      }
    });
    this.positions = new Float32Array(3 * vertices);
    this.normals = new Float32Array(3 * vertices);
    this.elementOf = new Int32Array(vertices);
    this.alongOf = new Float32Array(vertices);
    this.connect();
  }

  private connect(): void {
    const n = this.sides;
    const rings = this.segments + 1;
    for (let e = 0; e < this.curves.length; e++) {
      this.elementOf.fill(e, e * rings * n, (e + 1) * rings * n);
      for (let s = 0; s < this.segments; s++) {
        const a = (e * rings + s) * n;
        this.alongOf.fill((s + 1) / this.segments, a + n, a + 2 * n);
        for (let i = 0; i < n; i++) {
          const j = (i + 1) % n;
          this.indices.push(a + i, a + j, a + n + i, a + j, a + n + j, a + n + i);
        }
      }
    }
    for (const { element, atEnd, firstVertex } of this.caps) {
      this.elementOf.fill(element, firstVertex, firstVertex + n + 1);
      this.alongOf.fill(atEnd ? 1 : 0, firstVertex, firstVertex + n + 1);
      for (let i = 0; i < n; i++) {
        const j = (i + 1) % n;
        this.indices.push(firstVertex + n, firstVertex + (atEnd ? i : j));
        this.indices.push(firstVertex + (atEnd ? j : i));
      }
    }
  }

  /** Moves the vertices to the nodal values d (nodes × 6) magnified by `scale`. */
  deform(d: ArrayLike<number>, scale: number): void {
    const rings = this.segments + 1;
    this.body.elements.forEach(([a, b], e) => this.curves[e]!.deform(d, 6 * a, 6 * b, scale));
    for (const [a, b] of this.joins) this.mitre(a, b);
    for (let e = 0; e < this.curves.length; e++) {
      for (let s = 0; s < rings; s++) {
        this.ring((e * rings + s) * this.sides, e, s / this.segments, 0);
      }
    }
    for (const { element, atEnd, firstVertex } of this.caps) {
      this.ring(firstVertex, element, atEnd ? 1 : 0, atEnd ? 1 : -1);
    }
  }

  private mitre(a: End, b: End): void {
    const [out, into] = [a, b].map((end) => {
      const curve = this.curves[end >> 1]!;
      curve.at(end % 2);
      return unit(curve.tangent);
    }) as [Triple, Triple];
    const turn = -outwards(a) * outwards(b);
    const mean = unit(out.map((x, k) => x + turn * into[k]!));
    this.mitres[a] = mean;
    this.mitres[b] = mean.map((x) => turn * x) as Triple;
  }

  /** Writes one ring around the curve at ξ in [0, 1]; `capSign` ≠ 0 makes it the rim of a cap. */
  private ring(first: number, element: number, xi: number, capSign: number): void {
    const curve = this.curves[element]!;
    curve.at(xi);
    const { point, tangent } = curve;
    const [from, to] = this.radius[element]!;
    const r = from + xi * (to - from);
    // A cone's normals lean towards its thin end.
    const lean = (from - to) / (curve.length || 1);
    const end = xi === 0 ? 2 * element : xi === 1 ? 2 * element + 1 : -1;
    const t = this.mitres[end] ?? unit(tangent);
    const ref = this.reference[element]!;
    const along = dot(ref, t);
    const u = unit([ref[0] - along * t[0], ref[1] - along * t[1], ref[2] - along * t[2]]);
    const v = cross(t, u);
    const { positions, normals, circle } = this;
    for (let i = 0; i < this.sides; i++) {
      const [c, s] = [circle[2 * i]!, circle[2 * i + 1]!];
      for (let k = 0; k < 3; k++) {
        const out = c * u[k]! + s * v[k]!;
        const at = 3 * (first + i) + k;
        positions[at] = point[k]! + r * out;
        normals[at] = capSign === 0 ? (out + lean * t[k]!) / Math.hypot(1, lean) : capSign * t[k]!;
      }
    }
    if (capSign === 0) return;
    for (let k = 0; k < 3; k++) {
      this.positions[3 * (first + this.sides) + k] = point[k]!;
      this.normals[3 * (first + this.sides) + k] = capSign * t[k]!;
    }
  }
}
