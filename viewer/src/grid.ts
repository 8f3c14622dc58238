import * as THREE from 'three';
import { niceBelow } from './quantity';
import type { Bounds } from './bounds';
import type { Theme } from './theme';
import type { Orientation } from './orientation';

/** Cells from the centre to the rim; the lines fade out before it. */
const kReach = 24;

/** A grid through round coordinates below (3-D) or behind (planar) the model. */
export class Grid {
  readonly root: THREE.LineSegments;
  /** Spacing of the lines [m]. */
  readonly spacing: number;

  constructor(bounds: Bounds, orientation: Orientation, planar: boolean, theme: Theme) {
    this.spacing = niceBelow(bounds.size / 8);
    const normal = new THREE.Vector3(...orientation.gridNormal);
    const reference = new THREE.Vector3(Math.abs(normal.x) < 0.9 ? 1 : 0, 0, 0);
    if (reference.lengthSq() === 0) reference.set(0, 1, 0);
    const u = reference.addScaledVector(normal, -reference.dot(normal)).normalize();
    const v = new THREE.Vector3().crossVectors(normal, u);
    const center = new THREE.Vector3(...bounds.center);
    const below = bounds.half.reduce((sum, h, i) => sum + h * Math.abs(normal.getComponent(i)), 0);
    const depth = center.dot(normal) - (planar ? 0 : below + 0.02 * bounds.size);
    const snap = (x: number) => Math.round(x / this.spacing);
    const [cu, cv] = [snap(center.dot(u)), snap(center.dot(v))];

    const positions: number[] = [];
    const colors: number[] = [];
    const color = new THREE.Color(theme.grid);
    const vertex = (i: number, j: number, strength: number) => {
      const p = new THREE.Vector3()
        .addScaledVector(u, i * this.spacing)
        .addScaledVector(v, j * this.spacing)
        .addScaledVector(normal, depth);
      positions.push(...p.sub(center).toArray());
      const r = Math.hypot(i - cu, j - cv) / kReach;
      colors.push(color.r, color.g, color.b, strength * Math.max(0, 1 - r) ** 1.5);
    };
    for (let i = -kReach; i <= kReach; i++) {
      for (let j = -kReach; j < kReach; j++) {
        const [onU, onV] = [(cu + i) % 5 === 0 ? 0.65 : 0.25, (cv + i) % 5 === 0 ? 0.65 : 0.25];
        vertex(cu + i, cv + j, onU);
        vertex(cu + i, cv + j + 1, onU);
        vertex(cu + j, cv + i, onV);
        vertex(cu + j + 1, cv + i, onV);
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 4));
    const material = new THREE.LineBasicMaterial({
      vertexColors: true,
      transparent: true,
      depthWrite: false,
    });
    this.root = new THREE.LineSegments(geometry, material);
    this.root.position.copy(center);
    this.root.renderOrder = -1;
  }
}
