import * as THREE from 'three';
import { colorAt } from './color_map';
import { Surface } from './surface';
import type { BodyMotion } from './motion';

/** The surface of a solid body in the scene, with the edges of its elements. */
export class SurfaceMesh {
  readonly root = new THREE.Group();
  private readonly surface: Surface;
  private readonly geometry = new THREE.BufferGeometry();
  private readonly colors: THREE.BufferAttribute;
  private readonly values: Float32Array;
  private readonly plain: THREE.Color;
  private deformed = false;

  constructor(
    private readonly motion: BodyMotion,
    private readonly material: THREE.MeshStandardMaterial | THREE.MeshBasicMaterial,
    edgeColor: THREE.ColorRepresentation,
  ) {
    this.surface = new Surface(motion.body);
    const { positions, normals, indices, edges, nodeOf } = this.surface;
    const position = new THREE.BufferAttribute(positions, 3);
    this.geometry.setAttribute('position', position);
    this.geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    this.values = new Float32Array(nodeOf.length);
    this.colors = new THREE.BufferAttribute(new Float32Array(positions.length).fill(1), 3);
    this.geometry.setAttribute('color', this.colors);
    this.geometry.setIndex(indices);
    this.plain = material.color.clone();
    // Edges stand in front of the faces they bound.
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 1;
    const mesh = new THREE.Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    this.root.add(mesh);
    const lines = new THREE.BufferGeometry();
    lines.setAttribute('position', position);
    lines.setIndex(edges);
    const thin = new THREE.LineBasicMaterial({ color: edgeColor, transparent: true, opacity: 0.3 });
    const net = new THREE.LineSegments(lines, thin);
    net.frustumCulled = false;
    this.root.add(net);
  }

  deform(displacement: Float32Array, scale: number): void {
    if (!this.motion.body.displacement && this.deformed) return;
    this.deformed = true;
    this.surface.deform(displacement, scale);
    this.geometry.getAttribute('position').needsUpdate = true;
    this.geometry.getAttribute('normal').needsUpdate = true;
  }

  /** Colours the surface by the stresses of its elements, or all of it plainly for null. */
  paint(stress: Float32Array | null, range: number): void {
    const colored = stress !== null && range > 0;
    if (this.material.vertexColors !== colored) {
      this.material.vertexColors = colored;
      this.material.color.copy(colored ? new THREE.Color(0xffffff) : this.plain);
      this.material.needsUpdate = true;
    }
    if (!colored) return;
    this.surface.vertexValues(stress, this.values);
    const color = new THREE.Color();
    this.values.forEach((value, v) => {
      color.setRGB(...colorAt(value / range), THREE.SRGBColorSpace);
      color.toArray(this.colors.array, 3 * v);
    });
    this.colors.needsUpdate = true;
  }
}
