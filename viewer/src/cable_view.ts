import * as THREE from 'three';
import { cablePath, type CablePlace } from './cable_path';
import { solid } from './glyphs';
import type { Motion } from './motion';
import type { GlyphSize } from './body_view';
import type { Cable } from './run';
import type { Triple } from './page_data';
import type { Theme } from './theme';

const kZ = new THREE.Vector3(0, 0, 1);
/** Of the cable, in joint radii. */
const kThick = 0.22;
/** A point of the way as a tube between others. */
const kSides = 8;

/** A wheel of radius 1 about z with a groove, spokes and a mark, so that one sees it turn. */
function pulley(color: THREE.ColorRepresentation): THREE.Object3D {
  const material = solid(color);
  const group = new THREE.Group();
  const rim = new THREE.Mesh(new THREE.TorusGeometry(0.93, 0.07, 10, 48), material);
  group.add(rim);
  for (let k = 0; k < 3; k++) {
    const spoke = new THREE.Mesh(new THREE.BoxGeometry(1.8, 0.09, 0.06), material);
    spoke.rotation.z = (k * Math.PI) / 3;
    group.add(spoke);
  }
  const hub = new THREE.CylinderGeometry(0.16, 0.16, 0.16, 20).rotateX(Math.PI / 2);
  return group.add(new THREE.Mesh(hub, solid(0x20262e)));
}

/** A cable or belt as it runs around its pulleys. */
export class CableView {
  readonly root = new THREE.Group();
  private readonly pulleys: { glyph: THREE.Object3D; side: number }[] = [];
  private readonly rope: THREE.Mesh;

  constructor(
    private readonly cable: Cable,
    private readonly motion: Motion,
    theme: Theme,
    private readonly size: GlyphSize,
  ) {
    this.rope = new THREE.Mesh(new THREE.BufferGeometry(), solid(theme.text));
    this.root.add(this.rope);
    cable.radii.forEach((radius, side) => {
      if (radius === 0) return;
      const glyph = pulley(theme.joint);
      glyph.scale.setScalar(Math.abs(radius));
      this.pulleys.push({ glyph, side });
      this.root.add(glyph);
    });
  }

  /** Where its name stands: halfway along the first span. */
  position(scale: number): Triple {
    const [a, b] = [0, 1].map((k) => this.motion.side(this.cable.sides[k]!, scale)) as [Triple, Triple];
    return a.map((x, k) => (x + b[k]!) / 2) as Triple;
  }

  get name(): string {
    return this.cable.name;
  }

  update(scale: number): void {
    const { cable, motion } = this;
    const axis = motion.axisOf(cable);
    const places: CablePlace[] = cable.sides.map((side, k) => ({
      centre: motion.side(side, scale),
      radius: cable.radii[k]!,
    }));
    const points = cablePath(places, cable.closed, axis).map((p) => new THREE.Vector3(...p));
    this.rope.geometry.dispose();
    this.rope.geometry = tube(points, kThick * this.size.joint);
    for (const { glyph, side } of this.pulleys) {
      glyph.position.set(...places[side]!.centre);
      const upright = new THREE.Quaternion().setFromUnitVectors(kZ, new THREE.Vector3(...axis));
      const body = motion.bodies[cable.sides[side]!.body];
      glyph.quaternion.copy(upright);
      if (!body) continue;
      // Turned about the axis as its body is: the body's turn, its axis brought upright.
      const [w, x, y, z] = body.pose.slice(3);
      const turn = new THREE.Quaternion(x, y, z, w);
      const there = kZ.clone().applyQuaternion(turn.clone().multiply(upright));
      const back = new THREE.Quaternion().setFromUnitVectors(there, new THREE.Vector3(...axis));
      glyph.quaternion.copy(back.multiply(turn).multiply(upright));
    }
  }
}

/** A tube of one radius around a polygon. */
function tube(points: THREE.Vector3[], radius: number): THREE.BufferGeometry {
  const position: number[] = [];
  const index: number[] = [];
  let side = new THREE.Vector3(0, 0, 1);
  points.forEach((p, i) => {
    const before = points[Math.max(0, i - 1)]!;
    const behind = points[Math.min(points.length - 1, i + 1)]!;
    const along = behind.clone().sub(before).normalize();
    if (Math.abs(side.dot(along)) > 0.9) side = new THREE.Vector3(along.y, along.z, along.x);
    const u = side.clone().addScaledVector(along, -side.dot(along)).normalize();
    const v = along.clone().cross(u);
    side = u;
    for (let k = 0; k < kSides; k++) {
      const angle = (2 * Math.PI * k) / kSides;
      const q = p.clone().addScaledVector(u, radius * Math.cos(angle)).addScaledVector(v, radius * Math.sin(angle));
      position.push(q.x, q.y, q.z);
      if (i === 0) continue;
      const [a, b] = [(i - 1) * kSides + k, (i - 1) * kSides + ((k + 1) % kSides)];
      index.push(a, b, b + kSides, a, b + kSides, a + kSides);
    }
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}
