import * as THREE from 'three';
import { BodyCrowd } from './body_crowd';
import { isPlain, kFew } from './crowd_size';
import { JointCrowd } from './joint_crowd';
import { ReactionCrowd } from './reaction_crowd';
import { isCommon, ShapeCrowd } from './shape_crowd';
import { reachOf } from './shape_view';
import type { LargestReactions } from './reaction_view';
import type { Motion } from './motion';
import type { NamedGlyph } from './names';
import type { Joint, Shape } from './run';
import type { Theme } from './theme';
import type { ViewOptions } from './view_options';

/** Least radius of joints in pixels: a chain of thousands of links is still a line. */
const kPixels = 0.7;

/** Joints that are drawn so many times their size are not drawn at all. */
const kFar = 2;

/** What a crowd leaves to glyphs of their own. */
export interface Rest {
  /** Indices. */
  bodies: Set<number>;
  joints: Joint[];
  shapes: Shape[];
}

/** Joints that are few of their kind, or few on the ground: they keep their glyphs and supports. */
function fewJoints(joints: Joint[]): Set<Joint> {
  const kinds = new Map<string, Joint[]>();
  for (const joint of joints) {
    const key = `${joint.between[0]!.body < 0 ? 'ground' : ''} ${joint.type}`;
    const kind = kinds.get(key) ?? [];
    if (kind.length === 0) kinds.set(key, kind);
    kind.push(joint);
  }
  return new Set([...kinds.values()].filter(({ length }) => length <= kFew).flat());
}

/** The parts of a run that are too many to be drawn one by one. */
export class Crowd {
  readonly root = new THREE.Group();
  readonly rest: Rest;
  private readonly bodies: BodyCrowd;
  private readonly joints: JointCrowd;
  private readonly shapes: ShapeCrowd;
  private readonly reactions: ReactionCrowd;
  private reach = 0;

  /**
   * @param joints those that are drawn
   * @param shaped bodies with a shape of contact or a pulley
   * @param joint radius of joints seen from near [m]
   */
  constructor(
    private readonly motion: Motion,
    joints: Joint[],
    shaped: Set<number>,
    largest: LargestReactions,
    theme: Theme,
    private readonly joint: number,
  ) {
    const { run } = motion;
    const members = [...run.bodies.keys()].filter((i) => isPlain(run.bodies[i]!));
    const few = fewJoints(joints);
    const owner = new Map(members.map((index, i) => [index, i]));
    const common = run.shapes.filter((shape) => isCommon(shape) && owner.has(shape.on.body));
    const inCrowd = new Set(common);
    this.rest = {
      bodies: new Set([...run.bodies.keys()].filter((i) => !owner.has(i))),
      joints: joints.filter((one) => few.has(one)),
      shapes: run.shapes.filter((shape) => !inCrowd.has(shape)),
    };
    this.bodies = new BodyCrowd(motion, members, theme, shaped);
    this.joints = new JointCrowd(motion, joints.filter((one) => !few.has(one)), theme);
    const places = common.map(({ on }) => {
      const body = motion.bodies[on.body]!;
      const marker = body.body.markers[on.marker];
      return new THREE.Vector3(...(marker ? body.marker(marker, 1) : on.position));
    });
    common.forEach((shape, k) => {
      this.bodies.reachAtLeast(owner.get(shape.on.body)!, places[k]!.length() + reachOf(shape));
    });
    this.shapes = new ShapeCrowd(common, common.map(({ on }) => owner.get(on.body)!), places, theme);
    this.reactions = new ReactionCrowd(motion, run.joints.filter(({ force, torque }) => force || torque), largest);
    for (const { root } of this.all()) this.root.add(root);
  }

  /** Places of all joints. */
  namedJoints(): NamedGlyph[] {
    const { motion } = this;
    return motion.run.joints.map(({ name, between }) => ({
      name,
      position: (scale) => motion.side(between.at(-1)!, scale),
    }));
  }

  private all() {
    return [this.bodies, this.joints, this.shapes, this.reactions];
  }

  /**
   * @param pixel length of a pixel where the camera looks [m]
   * @param picture what it sees, world [m]
   */
  update(options: ViewOptions, pixel: number, picture: THREE.Frustum): void {
    // In steps, so that the forms of all parts are computed anew only now and then while one zooms.
    const wanted = Math.max(this.joint, kPixels * pixel);
    if (!(Math.abs(this.reach / wanted - 1) < 0.1)) this.reach = wanted;
    // Where joints are smaller than a pixel, bars alone show what there is to see.
    const isFar = wanted > kFar * this.joint;
    this.bodies.update(this.reach, isFar, picture, options.frames);
    const showsJoints = options.joints && !(isFar && this.bodies.hasBars);
    this.joints.root.visible = showsJoints;
    this.shapes.root.visible = options.joints;
    this.reactions.root.visible = options.reactions;
    if (showsJoints) this.joints.update(this.reach, picture);
    if (options.joints) this.shapes.update(this.bodies.frames, this.bodies.seen);
    if (options.reactions) this.reactions.update(this.reach);
  }

  dispose(): void {
    for (const part of this.all()) part.dispose();
  }
}
