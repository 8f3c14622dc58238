import * as THREE from 'three';
import { kFrame } from './copies';

/** Bars of bodies that are far away: lines from the mass centres, one pixel wide. */
export class FarBars {
  readonly root: THREE.LineSegments;
  private readonly positions: Float32Array;

  /** @param owners numbers of the frames, @param ends where the bars end within them */
  constructor(
    private readonly owners: number[],
    private readonly ends: THREE.Vector3[],
    colors: THREE.Color[],
  ) {
    this.positions = new Float32Array(6 * ends.length);
    const shades = new Float32Array(6 * ends.length);
    colors.forEach((color, i) => {
      color.toArray(shades, 6 * i);
      color.toArray(shades, 6 * i + 3);
    });
    const geometry = new THREE.BufferGeometry();
    const position = new THREE.BufferAttribute(this.positions, 3).setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute('position', position);
    geometry.setAttribute('color', new THREE.BufferAttribute(shades, 3));
    this.root = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true }));
    this.root.frustumCulled = false;
  }

  update(frames: Float32Array): void {
    const { positions: out, owners } = this;
    this.ends.forEach(({ x, y, z }, i) => {
      const f = kFrame * owners[i]!;
      for (let row = 0; row < 3; row++) {
        const origin = frames[f + 9 + row]!;
        out[6 * i + row] = origin;
        out[6 * i + 3 + row] =
          origin + frames[f + row]! * x + frames[f + 3 + row]! * y + frames[f + 6 + row]! * z;
      }
    });
    this.root.geometry.getAttribute('position').needsUpdate = true;
  }

  dispose(): void {
    this.root.geometry.dispose();
    (this.root.material as THREE.Material).dispose();
  }
}
