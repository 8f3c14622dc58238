import { cross, subtract, unit } from './beam_curve';
import { nodeAt, type Body } from './run';
import type { Triple } from './page_data';

/** Faces that meet at a larger angle have an edge between them: cos 40°. */
const kSmooth = 0.766;

/** A list of numbers that grows. */
class Growing {
  values = new Float64Array(1024);
  length = 0;

  push(value: number): void {
    if (this.length === this.values.length) {
      const more = new Float64Array(2 * this.length);
      more.set(this.values);
      this.values = more;
    }
    this.values[this.length++] = value;
  }
}

/** Triangles of the surface of a body; the topology is fixed, vertices follow the nodes. */
export class Surface {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: Uint32Array;
  /** Pairs of vertices: visible element edges, in halves if quadratic. */
  readonly edges: Uint32Array;
  /** Pairs of vertices: edges where the surface has a kink or ends. */
  readonly outline: Uint32Array;
  /** Node of each vertex; a node on an edge of the body has several. */
  readonly nodeOf: Int32Array;
  /** Field place of each vertex, −1 if it has none. */
  readonly placeOf: Int32Array;
  /** Four vertices of each face, the fourth −1 in triangles. */
  readonly corners: Int32Array;
  /** True if the surface has a boundary, as shells have: its back is visible. */
  readonly isOpen: boolean;

  constructor(private readonly body: Body) {
    const faces = body.faces!;
    this.corners = new Int32Array(faces.nodes.length);
    [this.nodeOf, this.placeOf] = this.makeVertices();
    this.positions = new Float32Array(3 * this.nodeOf.length);
    this.normals = new Float32Array(3 * this.nodeOf.length);
    this.indices = this.makeTriangles();
    const { edges, outline, isOpen } = this.makeEdges();
    [this.edges, this.outline, this.isOpen] = [edges, outline, isOpen];
    this.positions.set(this.restPositions());
  }

  /** Positions of the vertices in the undeformed body. */
  restPositions(): Float32Array {
    const rest = new Float32Array(3 * this.nodeOf.length);
    this.nodeOf.forEach((node, v) => rest.set(nodeAt(this.body, node), 3 * v));
    return rest;
  }

  /** Faces around a node share a vertex where the surface is smooth and fields are continuous. */
  private makeVertices(): [Int32Array, Int32Array] {
    const { nodes, places } = this.body.faces!;
    const [nodeOf, placeOf, next] = [new Growing(), new Growing(), new Growing()];
    const normals = new Growing();
    const first = new Int32Array(this.body.nodes.length / 3).fill(-1);
    for (let f = 0; f < nodes.length; f += 4) {
      const normal = this.undeformedNormal(f);
      for (let k = 0; k < 4; k++) {
        const node = nodes[f + k]!;
        const place = places ? places[f + k]! : -1;
        let vertex = node < 0 ? -1 : first[node]!;
        while (vertex >= 0) {
          const n = normals.values;
          const [x, y, z] = [n[3 * vertex]!, n[3 * vertex + 1]!, n[3 * vertex + 2]!];
          const along = x * normal[0] + y * normal[1] + z * normal[2];
          if (along > kSmooth && placeOf.values[vertex] === place) break;
          vertex = next.values[vertex]!;
        }
        if (vertex < 0 && node >= 0) {
          vertex = nodeOf.length;
          nodeOf.push(node);
          placeOf.push(place);
          next.push(first[node]!);
          for (const x of normal) normals.push(x);
          first[node] = vertex;
        }
        this.corners[f + k] = vertex;
      }
    }
    const list = ({ values, length }: Growing) => Int32Array.from(values.subarray(0, length));
    return [list(nodeOf), list(placeOf)];
  }

  /** Area vector of the face whose corners start at `at`. */
  private undeformedNormal(at: number): Triple {
    const nodes = this.body.faces!.nodes;
    const [p, q, r] = [0, 1, 2].map((k) => nodeAt(this.body, nodes[at + k]!));
    const fourth = nodes[at + 3]!;
    if (fourth < 0) return unit(cross(subtract(q!, p!), subtract(r!, p!)));
    return unit(cross(subtract(r!, p!), subtract(nodeAt(this.body, fourth), q!)));
  }

  private makeTriangles(): Uint32Array {
    const { corners } = this;
    const triangles = new Growing();
    for (let f = 0; f < corners.length; f += 4) {
      for (const k of corners[f + 3]! < 0 ? [2] : [2, 3]) {
        triangles.push(corners[f]!);
        triangles.push(corners[f + k - 1]!);
        triangles.push(corners[f + k]!);
      }
    }
    return Uint32Array.from(triangles.values.subarray(0, triangles.length));
  }

  /** The face that a triangle is part of: faces follow one another, each with one or two of them. */
  faceOf(triangle: number): number {
    let [face, after] = [-1, 0];
    while (after <= triangle) after += this.corners[4 * ++face + 3]! < 0 ? 1 : 2;
    return face;
  }

  private makeEdges() {
    const { corners, nodeOf } = this;
    const edges = new Growing();
    /** By its two nodes: where the edge is in the list. */
    const known = new Map<number, number>();
    const faces: number[] = [];
    const sharp: boolean[] = [];
    const count = this.body.nodes.length / 3;
    const elementEdges = this.body.faces!.edges;
    for (let f = 0; f < corners.length; f += 4) {
      const n = corners[f + 3]! < 0 ? 3 : 4;
      for (let k = 0; k < n; k++) {
        // Lines within a face of a quadratic element are not among its edges.
        if (elementEdges && !((elementEdges[f >> 2]! >> k) & 1)) continue;
        const [u, v] = [corners[f + k]!, corners[f + ((k + 1) % n)]!];
        const [a, b] = [nodeOf[u]!, nodeOf[v]!];
        const key = a < b ? a * count + b : b * count + a;
        const edge = known.get(key);
        if (edge === undefined) {
          known.set(key, faces.length);
          edges.push(u);
          edges.push(v);
          faces.push(1);
          sharp.push(false);
        } else {
          faces[edge]!++;
          const pair = [edges.values[2 * edge]!, edges.values[2 * edge + 1]!];
          if (!pair.includes(u) || !pair.includes(v)) sharp[edge] = true;
        }
      }
    }
    const all = Uint32Array.from(edges.values.subarray(0, edges.length));
    const outline = all.filter((_, i) => sharp[i >> 1] || faces[i >> 1] !== 2);
    return { edges: all, outline, isOpen: faces.some((number) => number === 1) };
  }

  /** `displacement` is nodes × `perNode` of the body. */
  deform(displacement: Float32Array, scale: number): void {
    const { positions, nodeOf } = this;
    const { nodes, perNode } = this.body;
    for (let v = 0, at = 0; v < nodeOf.length; v++, at += 3) {
      const n = 3 * nodeOf[v]!;
      const d = perNode * nodeOf[v]!;
      positions[at] = nodes[n]! + scale * displacement[d]!;
      positions[at + 1] = nodes[n + 1]! + scale * displacement[d + 1]!;
      positions[at + 2] = nodes[n + 2]! + scale * displacement[d + 2]!;
    }
    this.turnNormals();
  }

  /**
   * The sum of the area vectors of the faces around each vertex, as unit vectors. That of a face with
   * four corners is the product of its diagonals, be it plane or not.
   */
  private turnNormals(): void {
    const { positions: p, normals: n, corners } = this;
    n.fill(0);
    for (let f = 0; f < corners.length; f += 4) {
      const a = 3 * corners[f]!;
      const b = 3 * corners[f + 1]!;
      const c = 3 * corners[f + 2]!;
      const d = 3 * corners[f + 3]!;
      const e = d < 0 ? a : d;
      const ux = p[c]! - p[a]!;
      const uy = p[c + 1]! - p[a + 1]!;
      const uz = p[c + 2]! - p[a + 2]!;
      const vx = p[e]! - p[b]!;
      const vy = p[e + 1]! - p[b + 1]!;
      const vz = p[e + 2]! - p[b + 2]!;
      const x = uy * vz - uz * vy;
      const y = uz * vx - ux * vz;
      const z = ux * vy - uy * vx;
      n[a]! += x;
      n[a + 1]! += y;
      n[a + 2]! += z;
      n[b]! += x;
      n[b + 1]! += y;
      n[b + 2]! += z;
      n[c]! += x;
      n[c + 1]! += y;
      n[c + 2]! += z;
      if (d < 0) continue;
      n[d]! += x;
      n[d + 1]! += y;
      n[d + 2]! += z;
    }
    for (let v = 0; v < n.length; v += 3) {
      const length = Math.sqrt(n[v]! * n[v]! + n[v + 1]! * n[v + 1]! + n[v + 2]! * n[v + 2]!) || 1;
      n[v]! /= length;
      n[v + 1]! /= length;
      n[v + 2]! /= length;
    }
  }
}

const kSurfaces = new WeakMap<Body, Surface>();

/** The surface of a body; its topology is computed once, whatever draws it. */
export function surfaceOf(body: Body): Surface {
  let surface = kSurfaces.get(body);
  if (!surface) kSurfaces.set(body, (surface = new Surface(body)));
  return surface;
}
