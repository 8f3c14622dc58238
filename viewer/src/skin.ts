import type * as THREE from 'three';
import type { Painted } from './surface_values';

export type EdgeChoice = 'auto' | 'none' | 'outline' | 'mesh' | 'wireframe';

/** How a body is drawn, apart from its colours. */
export interface SkinLook {
  edges: EdgeChoice;
  /** What is on their negative side is cut away; null for nothing. */
  planes: THREE.Plane[] | null;
  /** Parts may be hidden by their values, so that the inside can be seen. */
  seeThrough: boolean;
}

/** What a vertex of the picture stands for; −1 for nothing. */
export interface PickedVertex {
  node: number;
  place: number;
  line: number;
}

/** What a body consists of when it is drawn: tubes, or the surface of a solid. */
export interface Skin {
  readonly root: THREE.Group;
  readonly mesh: THREE.Mesh;
  deform(displacement: Float32Array, scale: number): void;
  /** Colours by values (`byFace`: one per element), or plainly for null. */
  paint(painted: Painted | null, byFace: boolean): void;
  look(look: SkinLook): void;
  vertex(index: number): PickedVertex;
  /** The undeformed shape. */
  ghost(material: THREE.Material): THREE.Mesh;
  dispose(): void;
}
