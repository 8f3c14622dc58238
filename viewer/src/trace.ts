import * as THREE from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { Motion } from './motion';
import type { Run } from './run';
import type { Triple } from './page_data';
import type { TracePoint } from './view_options';

/** The path of one point through all stored frames: pale ahead of the current time, strong behind it. */
export class Trace {
  readonly root = new THREE.Group();
  private readonly motion: Motion;
  private readonly materials: LineMaterial[] = [];
  private passed: Line2 | null = null;
  private shown = '';

  constructor(
    run: Run,
    private readonly center: Triple,
  ) {
    // A separate motion, so that stepping through the frames does not disturb the picture.
    this.motion = new Motion(run);
    this.root.position.set(...center);
  }

  resize(width: number, height: number): void {
    for (const material of this.materials) material.resolution.set(width, height);
  }

  update(point: TracePoint | null, scale: number, index: number, color: string): void {
    const key = point ? `${point.body}/${point.marker}/${scale}/${color}` : '';
    if (key !== this.shown) this.rebuild(point, scale, color);
    this.shown = key;
    if (this.passed) this.passed.geometry.instanceCount = index;
  }

  /** The motion has changed: the path is rebuilt when it is drawn next. */
  forget(): void {
    this.shown = '';
  }

  private rebuild(point: TracePoint | null, scale: number, color: string): void {
    for (const child of this.root.children) (child as Line2).geometry.dispose();
    this.root.clear();
    this.materials.length = 0;
    this.passed = null;
    const frames = this.motion.run.times.length;
    if (!point || frames < 2) return;
    const body = this.motion.bodies.find((motion) => motion.body.name === point.body);
    const marker = body?.body.markers.find(({ name }) => name === point.marker);
    if (!body || (point.marker && !marker)) return;
    const path: number[] = [];
    for (let index = 0; index < frames; index++) {
      this.motion.setPlace({ index, fraction: 0 });
      const p = body.toWorld(marker ? body.marker(marker, scale) : [0, 0, 0]);
      path.push(p[0] - this.center[0], p[1] - this.center[1], p[2] - this.center[2]);
    }
    for (const strong of [false, true]) {
      const material = new LineMaterial({
        color,
        linewidth: strong ? 2.5 : 1.2,
        transparent: true,
        opacity: strong ? 1 : 0.45,
      });
      const line = new Line2(new LineGeometry().setPositions(path), material);
      line.frustumCulled = false;
      this.materials.push(material);
      this.root.add(line);
      if (strong) this.passed = line;
    }
  }
}
