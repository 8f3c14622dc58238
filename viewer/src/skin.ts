import type * as THREE from 'three';
import type { FieldMaterial } from './field_material';
import type { Painted } from './surface_values';

export type EdgeChoice = 'auto' | 'none' | 'outline' | 'mesh' | 'wireframe';

/** How a body is drawn, apart from its colours. */
export interface SkinLook {
  edges: EdgeChoice;
  /** Everything on their negative side is cut away; null for nothing. */
  planes: THREE.Plane[] | null;
  /** Parts may be hidden by their values, so that the inside can be seen. */
  seeThrough: boolean;
}

/** What a point of the picture belongs to; −1 for nothing. */
export interface PickedVertex {
  node: number;
  place: number;
  /** Element of the face under it. */
  element: number;
  line: number;
}

/** The drawn parts of a body: tubes, or the surface of a solid. */
export interface Skin {
  readonly root: THREE.Group;
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, FieldMaterial>;
  deform(displacement: Float32Array, scale: number): void;
  /** Colours by values (`byFace`: one per element), or plainly for null. */
  paint(painted: Painted | null, byFace: boolean): void;
  look(look: SkinLook): void;
  /** What a corner of a triangle belongs to, both by their numbers in the mesh. */
  vertex(index: number, triangle: number): PickedVertex;
  /** The undeformed shape. */
  ghost(material: THREE.Material): THREE.Mesh;
  dispose(): void;
}
