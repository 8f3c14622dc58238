import * as THREE from 'three';
import { arrow, turnArrow } from './glyphs';
import { interpolateRow } from './interpolation';
import type { GlyphSize } from './body_view';
import type { Motion } from './motion';
import type { Load } from './run';
import type { Triple } from './page_data';

/** Number of arrows of one load; more would hide the body. */
const kMostArrows = 200;
/** Length of the longest arrow in joint radii. */
const kLength = 12;
const kColor = 0xc026a8;

const kZ = new THREE.Vector3(0, 0, 1);

/** One load in the scene: arrows with lengths by its current value. */
export class LoadView {
  readonly root = new THREE.Group();
  private readonly arrows: { glyph: THREE.Object3D; foot: number }[] = [];
  private readonly largest: number;
  private readonly row: number[] = [];

  constructor(
    private readonly load: Load,
    private readonly motion: Motion,
    private readonly size: GlyphSize,
  ) {
    const { values, width } = load;
    let largest = 0;
    for (let i = 0; values && i < values.length; i += Math.max(1, width)) {
      const value = Math.hypot(...values.subarray(i, i + width));
      if (value > largest && value < Infinity) largest = value;
    }
    this.largest = values ? largest : 1;
    const turns = load.kind.includes('torque') || load.kind.includes('moment');
    const step = Math.max(1, Math.ceil(load.positions.length / kMostArrows));
    for (let foot = 0; foot < load.positions.length; foot += step) {
      const glyph = turns ? turnArrow(kColor) : arrow(kColor, 0.035);
      this.arrows.push({ glyph, foot });
      this.root.add(glyph);
    }
  }

  get name(): string {
    return this.load.name;
  }

  /** World position of a foot of an arrow. */
  private place(foot: number, scale: number): Triple {
    const { load, motion } = this;
    const body = motion.bodies[load.body];
    if (!body) return load.positions[foot]!;
    const node = load.nodes[foot]!;
    if (node < 0 || !body.body.displacement) return body.toWorld(load.positions[foot]!);
    const rest = load.positions[foot]!;
    const [moved, origin] = [body.node(node, scale), body.node(node, 0)];
    return body.toWorld(rest.map((x, k) => x + moved[k]! - origin[k]!));
  }

  /** Position of the first arrow; null for loads on all bodies, which have none. */
  position(scale: number): Triple | null {
    return this.load.positions.length > 0 ? this.place(0, scale) : null;
  }

  update(scale: number): void {
    const { load, motion, row } = this;
    if (load.values) interpolateRow(load.values, load.width, motion.place, row);
    const body = motion.bodies[load.body];
    for (const { glyph, foot } of this.arrows) {
      const factor = load.width === 1 ? row[0]! : 1;
      const given = load.width === 3 ? row : (load.directions[foot] ?? [0, 0, 0]);
      const v = new THREE.Vector3(given[0], given[1], given[2]).multiplyScalar(factor);
      if (body && (load.follows || load.width !== 3)) {
        const [w, x, y, z] = body.pose.slice(3);
        v.applyQuaternion(new THREE.Quaternion(x, y, z, w));
      }
      const share = this.largest > 0 ? v.length() / this.largest : 0;
      glyph.visible = share > 1e-3;
      if (!glyph.visible) continue;
      // Small values stay visible: the length scales with the square root of the value.
      const length = kLength * this.size.joint * Math.sqrt(Math.min(1, share));
      v.normalize();
      glyph.quaternion.setFromUnitVectors(kZ, v);
      glyph.scale.setScalar(length);
      const at = new THREE.Vector3(...this.place(foot, scale));
      glyph.position.copy(at);
      if (this.presses(v, at, factor)) glyph.position.addScaledVector(v, -length);
    }
  }

  /** Arrows of compressive loads end at the surface, others start there: none is hidden in the body. */
  private presses(v: THREE.Vector3, at: THREE.Vector3, factor: number): boolean {
    const { load, motion } = this;
    if (load.kind === 'pressure') return factor > 0;
    const body = motion.bodies[load.body];
    if (load.kind !== 'traction' || !body) return false;
    const [x, y, z] = body.pose as [number, number, number];
    return at.sub(new THREE.Vector3(x, y, z)).dot(v) < 0;
  }
}
