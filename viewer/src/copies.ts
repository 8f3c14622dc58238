import * as THREE from 'three';

/** Numbers of a frame: three columns of a turn and stretch, then the place. */
export const kFrame = 12;

/** Where each copy of a form sits: on which frame, and how within it. */
export interface Places {
  owners: Int32Array;
  /** Frames within those of the owners. */
  frames: Float32Array;
}

/** Thousands of copies of one form on frames that move, drawn in one call. */
export class Copies {
  readonly mesh: THREE.InstancedMesh;
  /** Of all copies, also those that are not drawn. */
  private readonly colors: Float32Array | null = null;

  /** @param colors one per copy, or the same for all */
  constructor(
    geometry: THREE.BufferGeometry,
    private places: Places,
    colors: THREE.ColorRepresentation | THREE.Color[],
  ) {
    const material = new THREE.MeshLambertMaterial({ vertexColors: geometry.hasAttribute('color') });
    const count = places.owners.length;
    this.mesh = new THREE.InstancedMesh(geometry, material, count);
    this.mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    // They move: their sphere is never computed.
    this.mesh.frustumCulled = false;
    if (!Array.isArray(colors)) {
      material.color.set(colors);
      return;
    }
    this.colors = new Float32Array(3 * count);
    colors.forEach((color, i) => color.toArray(this.colors!, 3 * i));
    this.mesh.instanceColor = new THREE.InstancedBufferAttribute(this.colors.slice(), 3);
  }

  /** Number of all copies. */
  get size(): number {
    return this.places.owners.length;
  }

  /** Other places of the same copies. */
  place(frames: Float32Array): void {
    this.places = { owners: this.places.owners, frames };
  }

  /**
   * @param frames of the owners, world
   * @param seen which owners are in the picture: nothing is drawn of the others
   */
  update(frames: Float32Array, seen: Uint8Array): void {
    const { owners, frames: local } = this.places;
    const { mesh, colors } = this;
    const out = mesh.instanceMatrix.array;
    let drawn = 0;
    for (let i = 0; i < owners.length; i++) {
      if (!seen[owners[i]!]) continue;
      const n = drawn++;
      if (colors) for (let k = 0; k < 3; k++) mesh.instanceColor!.array[3 * n + k] = colors[3 * i + k]!;
      const f = kFrame * owners[i]!;
      for (let column = 0; column < 4; column++) {
        const at = kFrame * i + 3 * column;
        const [x, y, z] = [local[at]!, local[at + 1]!, local[at + 2]!];
        const to = 16 * n + 4 * column;
        const shift = column === 3 ? 1 : 0;
        for (let row = 0; row < 3; row++) {
          out[to + row] =
            frames[f + row]! * x +
            frames[f + 3 + row]! * y +
            frames[f + 6 + row]! * z +
            shift * frames[f + 9 + row]!;
        }
        out[to + 3] = shift;
      }
    }
    mesh.count = drawn;
    mesh.instanceMatrix.needsUpdate = true;
    if (colors) mesh.instanceColor!.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    (this.mesh.material as THREE.Material).dispose();
    this.mesh.dispose();
  }
}

/** Puts the frame of a pose (position, then w, x, y, z) at number `index`. */
export function putPose(pose: ArrayLike<number>, frames: Float32Array, index: number): void {
  const [px, py, pz, w, x, y, z] = [0, 1, 2, 3, 4, 5, 6].map((i) => pose[i]!) as [
    number, number, number, number, number, number, number,
  ];
  frames.set(
    [
      1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
      2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
      2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y),
      px, py, pz,
    ],
    kFrame * index,
  );
}

const kHelp = new THREE.Object3D();

/** Puts a turn, a stretch and a place at number `index`. */
export function putPlace(
  position: THREE.Vector3,
  turn: THREE.Quaternion,
  stretch: THREE.Vector3,
  frames: Float32Array,
  index: number,
): void {
  kHelp.position.copy(position);
  kHelp.quaternion.copy(turn);
  kHelp.scale.copy(stretch);
  putObject(kHelp, frames, index);
}

/** The same of an object. */
export function putObject(object: THREE.Object3D, frames: Float32Array, index: number): void {
  object.updateMatrix();
  const m = object.matrix.elements;
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 3; row++) frames[kFrame * index + 3 * column + row] = m[4 * column + row]!;
  }
}
