import * as THREE from 'three';
import { plateOf, wireOf } from './curve_shape';
import { kZ, massCentre, quarteredDisc } from './glyphs';
import type { Motion } from './motion';
import type { Shape } from './run';
import type { Triple } from './page_data';
import type { Theme } from './theme';

/** Drawn part of a plane, as a share of the size of the model. */
const kPlane = 0.7;
/** Radius of a curve's wire, as a share of the size of the model, and thickness of a cam's plate, of its reach. */
const kWire = 0.006;
const kPlate = 0.15;
/** Lines of a plane. */
const kLines = 12;

/** A plane as a square with lines, at the origin across z. */
function planeOf(size: number, material: THREE.Material, color: THREE.ColorRepresentation): THREE.Object3D {
  const group = new THREE.Group();
  group.add(new THREE.Mesh(new THREE.PlaneGeometry(size, size), material));
  const lines = new THREE.GridHelper(size, kLines, color, color).rotateX(Math.PI / 2);
  const faint = lines.material as THREE.LineBasicMaterial;
  faint.transparent = true;
  faint.opacity = 0.5;
  return group.add(lines);
}

function meshOf(shape: Shape): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(shape.points!, 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(shape.triangles!), 1));
  geometry.computeVertexNormals();
  return geometry;
}

/** Long shapes have their axis along z here. @param wire radius of the wire of curves [m] */
function geometryOf(shape: Shape, wire: number): THREE.BufferGeometry | null {
  const { kind, radius, length, size } = shape;
  switch (kind) {
    case 'sphere':
      return new THREE.SphereGeometry(radius, 24, 16);
    case 'socket':
      return new THREE.SphereGeometry(radius, 32, 16, 0, 2 * Math.PI, Math.PI / 2, Math.PI / 2).rotateX(Math.PI / 2);
    case 'bore':
      return new THREE.CylinderGeometry(radius, radius, 2 * radius, 32, 1, true).rotateX(Math.PI / 2);
    case 'capsule':
      return new THREE.CapsuleGeometry(radius, length, 12, 24).rotateX(Math.PI / 2);
    case 'cylinder':
      return new THREE.CylinderGeometry(radius, radius, length, 32).rotateX(Math.PI / 2);
    case 'box':
      return new THREE.BoxGeometry(...size);
    case 'mesh':
      return shape.points ? meshOf(shape) : new THREE.BoxGeometry(...size);
    case 'curve':
      return shape.points && wireOf(shape.points, reachOf(shape), wire);
    case 'cam':
      return shape.points && plateOf(shape.points, shape.axis, kPlate * reachOf(shape));
    default:
      return null;
  }
}

/** Kinds of which there may be thousands. */
export type ShapeKey = 'sphere' | 'cylinder' | 'box';

/** Whether the shape has its own axes rather than one direction. */
export function isOriented(kind: string): boolean {
  return ['box', 'mesh', 'sphere', 'curve', 'cam'].includes(kind);
}

/** One shape of contact, or a curve that guides, half transparent: bodies and their shapes are seen at once. */
export class ShapeView {
  readonly root = new THREE.Group();
  private readonly own: THREE.Quaternion;

  /** @param size of the model [m], @param color of the body that carries it */
  constructor(
    private readonly shape: Shape,
    private readonly motion: Motion,
    theme: Theme,
    color: THREE.ColorRepresentation,
    size: number,
  ) {
    const onGround = shape.on.body < 0;
    const isHollow = ['socket', 'bore', 'plane', 'mesh'].includes(shape.kind);
    const material = new THREE.MeshLambertMaterial({
      color: onGround ? theme.muted : color,
      transparent: true,
      opacity: onGround ? 0.25 : 0.75,
      depthWrite: !onGround,
      side: isHollow ? THREE.DoubleSide : THREE.FrontSide,
    });
    const geometry = geometryOf(shape, kWire * size);
    if (shape.kind === 'sphere' && !onGround) {
      // In eight fields, so that one sees it roll.
      const ball = massCentre(color);
      ball.scale.setScalar(shape.radius);
      this.root.add(ball);
    } else if (shape.kind === 'wheel') {
      const disc = quarteredDisc(color);
      disc.scale.setScalar(shape.radius);
      this.root.add(disc);
    } else if (geometry) {
      this.root.add(new THREE.Mesh(geometry, material));
      if (shape.kind === 'mesh' || shape.kind === 'box') {
        const edges = new THREE.EdgesGeometry(geometry, shape.kind === 'mesh' ? 1 : 20);
        const line = new THREE.LineBasicMaterial({ color: theme.edge, transparent: true, opacity: 0.35 });
        this.root.add(new THREE.LineSegments(edges, line));
      }
    } else {
      this.root.add(planeOf(kPlane * size, material, theme.muted));
    }
    const [w, x, y, z] = shape.orientation;
    this.own = new THREE.Quaternion(x, y, z, w);
    if (isOriented(shape.kind)) return;
    const axis = new THREE.Vector3(...shape.axis);
    if (axis.lengthSq() > 0) this.own.multiply(new THREE.Quaternion().setFromUnitVectors(kZ, axis.normalize()));
  }

  position(scale: number): Triple {
    return this.motion.side(this.shape.on, scale);
  }

  update(scale: number): void {
    this.root.position.set(...this.position(scale));
    const body = this.motion.bodies[this.shape.on.body];
    this.root.quaternion.copy(this.own);
    if (!body) return;
    const [w, x, y, z] = body.pose.slice(3);
    this.root.quaternion.premultiply(new THREE.Quaternion(x, y, z, w));
  }
}

/** How far a shape reaches from its marker [m]; 0 where it has no end. */
export function reachOf(shape: Shape): number {
  switch (shape.kind) {
    case 'plane':
      return 0;
    case 'box':
    case 'mesh':
    case 'curve':
    case 'cam':
      return 0.5 * Math.hypot(...shape.size);
    default:
      return shape.radius + 0.5 * shape.length;
  }
}
