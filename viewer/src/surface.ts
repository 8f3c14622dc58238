import { cross, dot, unit } from './beam_curve';
import type { Body } from './run';
import type { Triple } from './page_data';

/** Faces that meet at a larger angle have an edge between them: cos 40°. */
const kSmooth = 0.766;

/** Triangles of the surface of a solid body; the topology is fixed, vertices follow the nodes. */
export class Surface {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: number[] = [];
  /** Pairs of vertices: the edges of the elements that can be seen. */
  readonly edges: number[] = [];
  /** Node of each vertex; a node on an edge of the body has several. */
  readonly nodeOf: number[] = [];
  /** Vertices of each face. */
  private readonly corners: number[][] = [];

  constructor(private readonly body: Body) {
    this.makeVertices();
    this.positions = new Float32Array(3 * this.nodeOf.length);
    this.normals = new Float32Array(3 * this.nodeOf.length);
    const drawn = new Set<string>();
    for (const corners of this.corners) {
      for (let k = 2; k < corners.length; k++) {
        this.indices.push(corners[0]!, corners[k - 1]!, corners[k]!);
      }
      corners.forEach((vertex, k) => {
        const next = corners[(k + 1) % corners.length]!;
        const [a, b] = [this.nodeOf[vertex]!, this.nodeOf[next]!];
        const key = a < b ? `${a} ${b}` : `${b} ${a}`;
        if (drawn.has(key)) return;
        drawn.add(key);
        this.edges.push(vertex, next);
      });
    }
  }

  /** Faces around a node share a vertex where the surface is smooth. */
  private makeVertices(): void {
    const at = new Map<number, { vertex: number; normal: Triple }[]>();
    for (const face of this.body.faces) {
      const nodes = face.filter((node) => node >= 0);
      const normal = this.undeformedNormal(nodes);
      this.corners.push(
        nodes.map((node) => {
          const known = at.get(node) ?? [];
          at.set(node, known);
          const same = known.find((other) => dot(other.normal, normal) > kSmooth);
          if (same) return same.vertex;
          const vertex = this.nodeOf.push(node) - 1;
          known.push({ vertex, normal });
          return vertex;
        }),
      );
    }
  }

  private undeformedNormal(nodes: number[]): Triple {
    const [p, q, r, s] = nodes.map((node) => this.body.nodes[node]!);
    const from = (a: Triple, b: Triple): Triple => [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    return unit(s ? cross(from(p!, r!), from(q!, s)) : cross(from(p!, q!), from(p!, r!)));
  }

  /** `displacement` is nodes × 6. */
  deform(displacement: Float32Array, scale: number): void {
    const { positions, body } = this;
    this.nodeOf.forEach((node, v) => {
      const p = body.nodes[node]!;
      for (let k = 0; k < 3; k++) {
        positions[3 * v + k] = p[k]! + scale * displacement[6 * node + k]!;
      }
    });
    this.turnNormals();
  }

  /** The sum of the area vectors around each vertex, as unit vectors. */
  private turnNormals(): void {
    const { positions: p, normals, indices } = this;
    normals.fill(0);
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
      const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
      const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
      const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      for (const at of [a, b, c]) for (let k = 0; k < 3; k++) normals[at + k]! += n[k]!;
    }
    for (let v = 0; v < normals.length; v += 3) {
      const length = Math.hypot(normals[v]!, normals[v + 1]!, normals[v + 2]!) || 1;
      for (let k = 0; k < 3; k++) normals[v + k]! /= length;
    }
  }

  /** Value of each vertex: the mean over the faces around it of what their elements have. */
  vertexValues(ofElements: Float32Array, out: Float32Array): void {
    const count = new Uint16Array(out.length);
    out.fill(0);
    this.corners.forEach((corners, face) => {
      const value = ofElements[this.body.faceElements[face]!]!;
      for (const vertex of corners) {
        out[vertex]! += value;
        count[vertex]!++;
      }
    });
    for (let v = 0; v < out.length; v++) out[v]! /= count[v] || 1;
  }
}
