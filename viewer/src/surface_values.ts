import type { FieldSource } from './fields';
import type { Faces } from './run';
import type { Surface } from './surface';

/**
 * Value of a vertex where nothing was recorded. So large that any fraction of it, however small, greys
 * a point between it and a recorded value; see field_material.ts.
 */
export const kNoValue = 3e38;

/** Where the given values belong. */
export interface Painted {
  on: FieldSource['on'];
  values: Float32Array;
}

/** Value of each vertex: its own, or the mean over the elements around it. */
export class VertexValues {
  private readonly count: Uint16Array;

  constructor(
    private readonly surface: Surface,
    private readonly faces: Faces,
  ) {
    this.count = new Uint16Array(surface.nodeOf.length);
  }

  fill({ on, values }: Painted, out: Float32Array): void {
    if (on === 'elements') {
      this.meanOfElements(values, out);
      return;
    }
    const index = on === 'nodes' ? this.surface.nodeOf : this.surface.placeOf;
    for (let v = 0; v < index.length; v++) {
      const value = index[v]! < 0 ? NaN : values[index[v]!]!;
      out[v] = Number.isNaN(value) ? kNoValue : value;
    }
  }

  private meanOfElements(values: Float32Array, out: Float32Array): void {
    const { count, surface, faces } = this;
    const { corners } = surface;
    count.fill(0);
    out.fill(0, 0, count.length);
    for (let c = 0; c < corners.length; c++) {
      const vertex = corners[c]!;
      const value = values[faces.elements[c >> 2]!]!;
      if (vertex < 0 || Number.isNaN(value)) continue;
      out[vertex]! += value;
      count[vertex]!++;
    }
    for (let v = 0; v < count.length; v++) out[v] = count[v] ? out[v]! / count[v]! : kNoValue;
  }
}

/** Value of each face: that of its element, or the mean of its corners. */
export function faceValue(surface: Surface, faces: Faces, painted: Painted, face: number): number {
  if (painted.on === 'elements') return painted.values[faces.elements[face]!]!;
  const index = painted.on === 'nodes' ? surface.nodeOf : surface.placeOf;
  let [sum, count] = [0, 0];
  for (let c = 4 * face; c < 4 * face + 4; c++) {
    const vertex = surface.corners[c]!;
    const place = vertex < 0 ? -1 : index[vertex]!;
    if (place < 0) continue;
    sum += painted.values[place]!;
    count++;
  }
  return count ? sum / count : NaN;
}
