import { decodeFloats, decodeInts, PageDataError } from './base64';
import type { Loop } from './section_profile';
import type { PageBody } from './page_data';

/** The surface of a solid body. */
export interface Faces {
  /** Four per face: nodes counter-clockwise seen from outside, the fourth −1 for triangles. */
  nodes: Int32Array;
  /** Element below each face, counted among those that have a face. */
  elements: Int32Array;
  /** Four per face: index of the corner's value in fields on `places`, −1 for none; or null. */
  places: Int32Array | null;
  /** Per face, bit k: its side from corner k is an edge of its element. Null if all are. */
  edges: Int32Array | null;
  numElements: number;
  numPlaces: number;
}

/** The cross-sections of the elements of a body. */
export interface Sections {
  /** For each section: the outline, then holes. */
  loops: Loop[][];
  /** Section at each end of an element; index 2 · element for the first end. */
  at: Int32Array;
  /** Elements × 3: local y axis in the body frame. */
  axes: Float32Array;
}

function most(numbers: Int32Array): number {
  return numbers.reduce((a, b) => Math.max(a, b), -1);
}

/** The surface of a solid body; null for others. */
export function decodeFaces(body: PageBody, count: number, where: string): Faces | null {
  if (!body.faces) return null;
  const nodes = decodeInts(body.faces, 4, `${where}.faces`);
  nodes.forEach((node, i) => {
    if (node >= count || node < (i % 4 === 3 ? -1 : 0)) {
      throw new PageDataError(`${where}.faces: no node ${node}`);
    }
  });
  const elements = decodeInts(body.faceElements ?? '', 1, `${where}.faceElements`);
  const places = body.facePlaces ? decodeInts(body.facePlaces, 4, `${where}.facePlaces`) : null;
  if (4 * elements.length !== nodes.length || (places && places.length !== nodes.length)) {
    throw new PageDataError(`${where}.faces: ${nodes.length / 4} faces, but not as many elements`);
  }
  const numElements = most(elements) + 1;
  const edges = body.faceEdges ? decodeInts(body.faceEdges, 1, `${where}.faceEdges`) : null;
  if (edges && edges.length !== elements.length) {
    throw new PageDataError(`${where}.faceEdges: ${edges.length} found, ${elements.length} expected`);
  }
  return { nodes, elements, places, edges, numElements, numPlaces: places ? most(places) + 1 : 0 };
}

/** The cross-sections of the elements of a body; null if it has none. */
export function decodeSections(body: PageBody, count: number, where: string): Sections | null {
  if (!body.sections || body.sections.length === 0) return null;
  const loops = body.sections.map((section) =>
    section.map((text): Loop => {
      const bits = decodeInts(text, 2, `${where}.sections`);
      const points = new Float32Array(bits.buffer, 0, bits.length);
      return [...Array(points.length / 2)].map((_, i) => [points[2 * i]!, points[2 * i + 1]!]);
    }),
  );
  const at = decodeInts(body.elementSections ?? '', 2, `${where}.elementSections`);
  if (at.length !== 2 * count || at.some((section) => section < 0 || section >= loops.length)) {
    throw new PageDataError(`${where}.elementSections: they do not fit the elements`);
  }
  return { loops, at, axes: decodeFloats(body.elementAxes ?? '', 3 * count, `${where}.elementAxes`) };
}
