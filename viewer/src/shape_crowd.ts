import * as THREE from 'three';
import { Copies, kFrame, putPlace } from './copies';
import { isOriented, type ShapeKey } from './shape_view';
import { kZ } from './glyphs';
import type { Shape } from './run';
import type { Theme } from './theme';

/** A ball in eight fields, light and dark by turns: one sees it roll. */
function fieldedBall(): THREE.BufferGeometry {
  const geometry = new THREE.SphereGeometry(1, 12, 8).toNonIndexed();
  const position = geometry.getAttribute('position').array;
  const shades = new Float32Array(position.length);
  for (let i = 0; i < position.length; i += 9) {
    let sign = 1;
    for (let k = 0; k < 3; k++) sign *= position[i + k]! + position[i + 3 + k]! + position[i + 6 + k]! >= 0 ? 1 : -1;
    shades.fill(sign > 0 ? 1 : 0.55, i, i + 9);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(shades, 3));
  return geometry;
}

/** Form of size one, and the stretch that gives it its size; null for kinds that are drawn one by one. */
function formOf({ kind, radius, length, size }: Shape): { key: ShapeKey; stretch: [number, number, number] } | null {
  switch (kind) {
    case 'sphere':
      return { key: 'sphere', stretch: [radius, radius, radius] };
    case 'cylinder':
      return { key: 'cylinder', stretch: [radius, radius, length] };
    case 'box':
      return { key: 'box', stretch: [...size] };
    default:
      return null;
  }
}

function geometryOf(key: ShapeKey): THREE.BufferGeometry {
  if (key === 'sphere') return fieldedBall();
  if (key === 'cylinder') return new THREE.CylinderGeometry(1, 1, 1, 16).rotateX(Math.PI / 2);
  return new THREE.BoxGeometry(1, 1, 1);
}

/** Whether a shape can be one of many. */
export function isCommon(shape: Shape): boolean {
  return shape.on.body >= 0 && formOf(shape) !== null;
}

/** Balls, cylinders and boxes of contact by the thousand. */
export class ShapeCrowd {
  readonly root = new THREE.Group();
  private readonly forms: Copies[] = [];

  /**
   * @param shapes isCommon()
   * @param owners number of the frame of each one's body
   * @param at places within the frames
   */
  constructor(shapes: Shape[], owners: number[], at: THREE.Vector3[], theme: Theme) {
    const palette = theme.bodies.map((color) => new THREE.Color(color));
    for (const key of ['sphere', 'cylinder', 'box'] as const) {
      const own = [...shapes.keys()].filter((k) => formOf(shapes[k]!)!.key === key);
      if (own.length === 0) continue;
      const frames = new Float32Array(kFrame * own.length);
      own.forEach((k, i) => {
        const shape = shapes[k]!;
        const [w, x, y, z] = shape.orientation;
        const turn = new THREE.Quaternion(x, y, z, w);
        const axis = new THREE.Vector3(...shape.axis);
        if (!isOriented(shape.kind) && axis.lengthSq() > 0) {
          turn.multiply(new THREE.Quaternion().setFromUnitVectors(kZ, axis.normalize()));
        }
        putPlace(at[k]!, turn, new THREE.Vector3(...formOf(shape)!.stretch), frames, i);
      });
      const places = { owners: Int32Array.from(own, (k) => owners[k]!), frames };
      const colors = own.map((k) => palette[shapes[k]!.on.body % palette.length]!);
      const copies = new Copies(geometryOf(key), places, colors);
      this.forms.push(copies);
      this.root.add(copies.mesh);
    }
  }

  /** @param frames of the bodies, and which of them are in the picture */
  update(frames: Float32Array, seen: Uint8Array): void {
    for (const form of this.forms) form.update(frames, seen);
  }

  dispose(): void {
    for (const form of this.forms) form.dispose();
  }
}
