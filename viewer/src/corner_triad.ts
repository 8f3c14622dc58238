import * as THREE from 'three';
import { arrow, kAxisColors, triad } from './glyphs';
import type { Triple } from './page_data';

/** World axes and the direction of gravity in a corner of the view, always the same size. */
export class CornerTriad {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.OrthographicCamera(-1.6, 1.6, 1.6, -1.6, 0, 10);
  /** Tips and their labels, shown over the canvas. */
  readonly tips: { text: string; at: THREE.Vector3; color: string }[];

  constructor(gravity: Triple) {
    this.scene.add(triad(0.05));
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x888888, 2.6));
    this.tips = ['x', 'y', 'z'].map((text, i) => ({
      text,
      at: new THREE.Vector3().setComponent(i, 1.25),
      color: `#${kAxisColors[i]!.toString(16)}`,
    }));
    const g = new THREE.Vector3(...gravity);
    if (g.lengthSq() > 0) {
      const pull = arrow(0xa855c8, 0.06);
      pull.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), g.clone().normalize());
      this.scene.add(pull);
      this.tips.push({ text: 'g', at: g.normalize().multiplyScalar(1.25), color: '#a855c8' });
    }
  }

  /** Draws into the lower left corner of the canvas; `edge` in CSS pixels. */
  render(renderer: THREE.WebGLRenderer, camera: THREE.Camera, edge: number): void {
    this.camera.quaternion.copy(camera.quaternion);
    this.camera.position.set(0, 0, 5).applyQuaternion(camera.quaternion);
    this.camera.updateMatrixWorld();
    const size = renderer.getSize(new THREE.Vector2());
    renderer.autoClear = false;
    renderer.clearDepth();
    renderer.setViewport(0, 0, edge, edge);
    renderer.render(this.scene, this.camera);
    renderer.setViewport(0, 0, size.x, size.y);
    renderer.autoClear = true;
  }

  /** Position of a tip inside the corner square, 0 … 1 from the left and from the top. */
  project(at: THREE.Vector3): [number, number] {
    const p = at.clone().project(this.camera);
    return [(p.x + 1) / 2, (1 - p.y) / 2];
  }
}
