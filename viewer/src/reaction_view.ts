import * as THREE from 'three';
import { arrow, turnArrow } from './glyphs';
import { interpolateRow } from './interpolation';
import { figure, prefixFor } from './quantity';
import type { GlyphSize } from './body_view';
import type { Motion } from './motion';
import type { Joint, Run } from './run';
import type { Triple } from './page_data';

/** Length of the longest arrow in joint radii. */
export const kLength = 12;
export const kReactionColor = 0x0e8f7e;
/** Less than this share of the largest is not drawn. */
export const kLeast = 1e-3;

const kZ = new THREE.Vector3(0, 0, 1);

/** Largest force and torque of all joints over the run: all arrows share their scale. */
export interface LargestReactions {
  force: number;
  torque: number;
}

export function largestReactions(run: Run): LargestReactions {
  const largest = (values: Float32Array | null) => {
    let most = 0;
    for (let i = 0; values && i < values.length; i += 3) {
      const size = Math.hypot(values[i]!, values[i + 1]!, values[i + 2]!);
      if (size > most && size < Infinity) most = size;
    }
    return most;
  };
  return {
    force: run.joints.reduce((most, { force }) => Math.max(most, largest(force)), 0),
    torque: run.joints.reduce((most, { torque }) => Math.max(most, largest(torque)), 0),
  };
}

/** The action of one joint on its last side: arrows of force and torque, and their values as text. */
export class ReactionView {
  readonly root = new THREE.Group();
  /** "1.2 kN"; empty where nothing acts. */
  text = '';
  private readonly force = arrow(kReactionColor, 0.035);
  private readonly torque = turnArrow(kReactionColor);
  private readonly row: number[] = [];

  constructor(
    private readonly joint: Joint,
    private readonly motion: Motion,
    private readonly size: GlyphSize,
    private readonly largest: LargestReactions,
  ) {
    this.root.add(this.force, this.torque);
  }

  /** World position of the arrows' feet. */
  position(scale: number): Triple {
    return this.motion.side(this.joint.between.at(-1)!, scale);
  }

  update(scale: number): void {
    const { joint, largest } = this;
    this.root.position.set(...this.position(scale));
    const texts = [
      this.turn(this.force, joint.force, largest.force, 'N'),
      this.turn(this.torque, joint.torque, largest.torque, 'N m'),
    ];
    this.text = texts.filter((text) => text !== '').join(', ');
  }

  /** Turns and stretches an arrow; returns its value as text. */
  private turn(
    glyph: THREE.Object3D,
    values: Float32Array | null,
    largest: number,
    unit: string,
  ): string {
    glyph.visible = false;
    if (!values || !(largest > 0)) return '';
    interpolateRow(values, 3, this.motion.place, this.row);
    const v = new THREE.Vector3(this.row[0], this.row[1], this.row[2]);
    const value = v.length();
    if (!(value > kLeast * largest)) return '';
    glyph.visible = true;
    glyph.quaternion.setFromUnitVectors(kZ, v.normalize());
    // Small values stay visible: the length scales with the square root of the value.
    glyph.scale.setScalar(kLength * this.size.joint * Math.sqrt(Math.min(1, value / largest)));
    const prefix = prefixFor(value, unit);
    return `${figure(value / prefix.factor, 3)} ${prefix.unit}`;
  }
}
