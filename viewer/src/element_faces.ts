import type { Surface } from './surface';

/**
 * The triangles of a surface for one colour per face. The graphics card takes such a value from the
 * last vertex of a triangle, so every face gets a vertex of its own; few vertices have to be doubled
 * for that (none in most meshes of quadrilaterals).
 */
export class ElementFaces {
  readonly indices: Uint32Array;
  /** Vertex of the surface behind each vertex; the first ones are the same. */
  readonly vertexOf: Int32Array;
  /** The vertex with the value of each face. */
  readonly carrier: Int32Array;
  readonly positions: Float32Array;
  readonly normals: Float32Array;

  constructor(private readonly surface: Surface) {
    const { corners, nodeOf } = surface;
    const faces = corners.length / 4;
    const owned = new Uint8Array(nodeOf.length);
    const doubled: number[] = [];
    this.carrier = new Int32Array(faces);
    const triangles: number[] = [];
    for (let f = 0; f < faces; f++) {
      const count = corners[4 * f + 3]! < 0 ? 3 : 4;
      const corner = (k: number) => corners[4 * f + (k % count)]!;
      let own = 0;
      while (own < count && owned[corner(own)]) own++;
      own %= count;
      let carrier = corner(own);
      if (owned[carrier]) {
        doubled.push(carrier);
        carrier = nodeOf.length + doubled.length - 1;
      } else {
        owned[carrier] = 1;
      }
      this.carrier[f] = carrier;
      triangles.push(corner(own + 1), corner(own + 2), carrier);
      if (count === 4) triangles.push(corner(own + 2), corner(own + 3), carrier);
    }
    this.indices = Uint32Array.from(triangles);
    this.vertexOf = new Int32Array(nodeOf.length + doubled.length).map((_, v) =>
      v < nodeOf.length ? v : doubled[v - nodeOf.length]!,
    );
    this.positions = new Float32Array(3 * this.vertexOf.length);
    this.normals = new Float32Array(3 * this.vertexOf.length);
  }

  /** Follows the surface. */
  update(): void {
    const { positions, normals, nodeOf } = this.surface;
    this.positions.set(positions);
    this.normals.set(normals);
    for (let v = nodeOf.length; v < this.vertexOf.length; v++) {
      const from = 3 * this.vertexOf[v]!;
      for (let k = 0; k < 3; k++) {
        this.positions[3 * v + k] = positions[from + k]!;
        this.normals[3 * v + k] = normals[from + k]!;
      }
    }
  }
}
