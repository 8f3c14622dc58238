import * as THREE from 'three';
import { rod, solid, span, spring, support } from './glyphs';
import { jointGlyph } from './joint_glyphs';
import { Motion, rotate } from './motion';
import type { GlyphSize } from './body_view';
import type { Joint } from './run';
import type { Triple } from './page_data';
import type { Theme } from './theme';

const kZ = new THREE.Vector3(0, 0, 1);

function isSpring(joint: Joint): boolean {
  return joint.type.toLowerCase().includes('spring');
}

function isPrismatic(joint: Joint): boolean {
  return joint.type.toLowerCase() === 'prismatic';
}

/**
 * One joint in the scene: its glyph at its last side, a support under what is attached to
 * the ground, a line between the two sides when they are apart (springs, or a magnified deformation).
 */
export class JointView {
  readonly root = new THREE.Group();
  private readonly glyph: THREE.Object3D | null;
  private readonly link: THREE.Object3D;
  private readonly rail: THREE.Mesh | null = null;
  private readonly support: THREE.Object3D | null = null;

  constructor(
    private readonly joint: Joint,
    private readonly motion: Motion,
    theme: Theme,
    private readonly size: GlyphSize,
    up: Triple,
  ) {
    this.glyph = isSpring(joint) ? null : jointGlyph(joint.type, theme.joint);
    if (this.glyph) {
      this.glyph.scale.setScalar(size.joint);
      this.root.add(this.glyph);
    }
    const line = new THREE.MeshBasicMaterial({ color: theme.muted });
    this.link = isSpring(joint) ? spring(theme.text) : rod(line);
    this.root.add(this.link);

    const onGround = joint.between[0]!.body < 0;
    if (isPrismatic(joint) && onGround) {
      this.rail = this.addRail(theme);
    } else if (onGround && !joint.type.startsWith('prescribed')) {
      this.support = support(theme.muted);
      this.support.scale.setScalar(size.joint);
      this.support.quaternion.setFromUnitVectors(kZ, new THREE.Vector3(...up));
      this.root.add(this.support);
    }
  }

  /** A bar along the axis as long as the travel of the slider. */
  private addRail(theme: Theme): THREE.Mesh {
    const axis = new THREE.Vector3(...this.axis());
    const origin = new THREE.Vector3(...this.motion.side(this.joint.between[0]!, 1));
    const frames = this.motion.run.times.length;
    const step = Math.max(1, Math.floor(frames / 200));
    let [low, high] = [0, 0];
    for (let index = 0; index < frames; index += step) {
      this.motion.setPlace({ index, fraction: 0 });
      const other = new THREE.Vector3(...this.motion.side(this.joint.between.at(-1)!, 1));
      const way = other.sub(origin).dot(axis);
      [low, high] = index === 0 ? [way, way] : [Math.min(low, way), Math.max(high, way)];
    }
    const rail = rod(solid(theme.muted));
    const margin = 4 * this.size.joint;
    const ends = [low - margin, high + margin].map((s) => origin.clone().addScaledVector(axis, s));
    span(rail, ends[0]!, ends[1]!, 0.35 * this.size.joint);
    this.root.add(rail);
    return rail;
  }

  /** In the world. */
  private axis(): Triple {
    const first = this.motion.bodies[this.joint.between[0]!.body];
    return first ? rotate(first.pose, 3, this.joint.axis) : this.joint.axis;
  }

  get name(): string {
    return this.joint.name;
  }

  /** World position of the glyph and of the label. */
  position(scale: number): Triple {
    return this.motion.side(this.joint.between.at(-1)!, scale);
  }

  update(scale: number): void {
    const a = new THREE.Vector3(...this.motion.side(this.joint.between[0]!, scale));
    const b = new THREE.Vector3(...this.position(scale));
    if (this.glyph) {
      this.glyph.position.copy(b);
      const axis = new THREE.Vector3(...this.axis());
      if (axis.lengthSq() > 0) this.glyph.quaternion.setFromUnitVectors(kZ, axis.normalize());
    }
    this.support?.position.copy(a);
    const apart = a.distanceTo(b) > 0.2 * this.size.joint;
    this.link.visible = apart && !this.rail;
    span(this.link, a, b, (isSpring(this.joint) ? 0.9 : 0.15) * this.size.joint);
  }
}
