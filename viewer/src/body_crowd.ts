import * as THREE from 'three';
import { FarBars } from './far_bars';
import { Copies, kFrame, putObject, putPose, type Places } from './copies';
import { kAxisColors, kZ, span } from './glyphs';
import type { Motion } from './motion';
import type { Theme } from './theme';

const kOrigin = new THREE.Vector3();
/** Few faces: a body of a crowd is a few pixels wide. */
const bar = () => new THREE.CylinderGeometry(1, 1, 1, 5, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const tip = () => new THREE.OctahedronGeometry(1);
const centre = () => new THREE.IcosahedronGeometry(1);

/** Copies with how they sit for a radius of joints. */
interface Part {
  copies: Copies;
  /** Not worth drawing from afar. */
  isDetail: boolean;
  /** Radius of joints for which it is placed. */
  joint: number;
  frames: (joint: number) => Float32Array;
}

/** Places a copy, given its number and the radius of joints. */
type Put = (object: THREE.Object3D, index: number, joint: number) => void;

/** Rigid bodies by the thousand: bars from the mass centre to the markers, as single ones have them. */
export class BodyCrowd {
  readonly root = new THREE.Group();
  /** Of the members, as Copies takes them. */
  readonly frames: Float32Array;
  /** Which of the members are in the picture. */
  readonly seen: Uint8Array;
  /** Whether any body is drawn as bars. */
  readonly hasBars: boolean;
  private readonly parts: Part[] = [];
  private triads: Copies[] = [];
  private readonly lines: FarBars;
  /** How far each member reaches [m]. */
  private readonly reach: Float32Array;

  /**
   * @param members indices of the bodies
   * @param shaped bodies with a shape of contact, which need no box
   */
  constructor(
    private readonly motion: Motion,
    private readonly members: number[],
    theme: Theme,
    shaped: Set<number>,
  ) {
    this.frames = new Float32Array(kFrame * members.length);
    this.seen = new Uint8Array(members.length);
    this.reach = new Float32Array(members.length);
    const palette = theme.bodies.map((color) => new THREE.Color(color));
    const ends: { owner: number; at: THREE.Vector3 }[] = [];
    const centres: number[] = [];
    const boxes: number[] = [];
    members.forEach((index, owner) => {
      const { markers } = motion.bodies[index]!.body;
      const far = markers.map(({ position }) => new THREE.Vector3(...position)).filter((p) => p.length() > 0);
      for (const at of far) {
        ends.push({ owner, at });
        this.reach[owner] = Math.max(this.reach[owner]!, at.length());
      }
      if (far.length > 0) centres.push(owner);
      else if (!shaped.has(index)) boxes.push(owner);
    });
    const colorOf = (owner: number) => palette[members[owner]! % palette.length]!;
    const ofEnds = ends.map(({ owner }) => owner);
    this.lines = new FarBars(ofEnds, ends.map(({ at }) => at), ofEnds.map(colorOf));
    this.root.add(this.lines.root);
    const add = (geometry: THREE.BufferGeometry, owners: number[], put: Put, isDetail = false) =>
      this.add(geometry, owners, owners.map(colorOf), put, isDetail);
    add(bar(), ofEnds, (object, i, joint) => span(object, kOrigin, ends[i]!.at, 0.5 * joint), true);
    const atEnd: Put = (object, i, joint) => {
      object.position.copy(ends[i]!.at);
      object.scale.setScalar(0.7 * joint);
    };
    add(tip(), ofEnds, atEnd, true);
    const atOrigin = (stretch: number): Put => (object, _, joint) => {
      object.scale.setScalar(stretch * joint);
    };
    add(centre(), centres, atOrigin(0.95), true);
    this.hasBars = ends.length > 0;
    add(new THREE.BoxGeometry(4.6, 3.4, 2.4), boxes, atOrigin(1));
  }

  private add(
    geometry: THREE.BufferGeometry,
    owners: number[],
    colors: THREE.Color[],
    put: Put,
    isDetail: boolean,
  ): void {
    if (owners.length === 0) return;
    const object = new THREE.Object3D();
    const frames = (joint: number) => {
      const out = new Float32Array(kFrame * owners.length);
      owners.forEach((_, i) => {
        put(object, i, joint);
        putObject(object, out, i);
      });
      return out;
    };
    const places: Places = { owners: Int32Array.from(owners), frames: new Float32Array(0) };
    const copies = new Copies(geometry, places, colors);
    this.parts.push({ copies, isDetail, joint: 0, frames });
    this.root.add(copies.mesh);
  }

  /** A shape of contact of a member reaches as far [m]: it is in the picture as long as that. */
  reachAtLeast(owner: number, length: number): void {
    this.reach[owner] = Math.max(this.reach[owner]!, length);
  }

  /**
   * @param joint radius of joints [m]
   * @param isFar parts cannot be told from each other
   * @param picture what the camera sees, world [m]
   */
  update(joint: number, isFar: boolean, picture: THREE.Frustum, showsFrames: boolean): void {
    const sphere = new THREE.Sphere();
    this.members.forEach((index, i) => {
      const { pose } = this.motion.bodies[index]!;
      putPose(pose, this.frames, i);
      sphere.center.set(pose[0]!, pose[1]!, pose[2]!);
      sphere.radius = this.reach[i]! + 6 * joint;
      this.seen[i] = picture.intersectsSphere(sphere) ? 1 : 0;
    });
    this.lines.root.visible = isFar;
    if (isFar) this.lines.update(this.frames);
    if (showsFrames && this.triads.length === 0) this.addTriads();
    for (const part of this.parts) {
      part.copies.mesh.visible = !(isFar && part.isDetail);
      if (!part.copies.mesh.visible) continue;
      if (part.joint !== joint) part.copies.place(part.frames(joint));
      part.joint = joint;
      part.copies.update(this.frames, this.seen);
    }
    this.triads.forEach((axis, k) => {
      axis.mesh.visible = showsFrames;
      if (!showsFrames) return;
      axis.place(this.axisFrames(k, joint));
      axis.update(this.frames, this.seen);
    });
  }

  private addTriads(): void {
    const owners = Int32Array.from(this.members.keys());
    this.triads = kAxisColors.map((color) => new Copies(bar(), { owners, frames: new Float32Array(0) }, color));
    for (const { mesh } of this.triads) this.root.add(mesh);
  }

  private axisFrames(axis: number, joint: number): Float32Array {
    const object = new THREE.Object3D();
    object.quaternion.setFromUnitVectors(kZ, new THREE.Vector3().setComponent(axis, 1));
    object.scale.set(0.2 * joint, 0.2 * joint, 6 * joint);
    const out = new Float32Array(kFrame * this.members.length);
    putObject(object, out, 0);
    for (let i = 1; i < this.members.length; i++) out.copyWithin(kFrame * i, 0, kFrame);
    return out;
  }

  dispose(): void {
    this.lines.dispose();
    for (const { copies } of this.parts) copies.dispose();
    for (const copies of this.triads) copies.dispose();
  }
}
