import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { KeptCamera } from './hook';
import type { Triple } from './page_data';

const kFieldOfView = 32;
/** Least distance to the target, as a share of the size of the run. */
export const kClosest = 0.01;

/** Widths of the controls over the edges of the picture [CSS px]. */
export interface Insets {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Two cameras behind one set of mouse controls. Scene units: the run's size is 1. */
export class CameraRig {
  private readonly perspective: THREE.PerspectiveCamera;
  private readonly parallel = new THREE.OrthographicCamera(-1, 1, 1, -1, -30, 60);
  private controls!: OrbitControls;
  private aspect = 1;
  private width = 1;
  private tall = 1;
  private insets: Insets = { left: 0, top: 0, right: 0, bottom: 0 };
  /** The box that was fitted last, unless the camera was moved since. */
  private fitted: { half: Triple; back: Triple | undefined } | null = null;
  /** While it follows another camera, its moves are not reported. */
  private quiet = false;
  /** Visible height at the target in the orthographic view before zoom. */
  private height = 1;

  constructor(
    private readonly element: HTMLElement,
    private readonly up: Triple,
    public orthographic: boolean,
    private readonly changed: () => void,
    /** Least distance to the target. */
    private readonly closest = kClosest,
  ) {
    this.perspective = new THREE.PerspectiveCamera(kFieldOfView, 1, closest / 5, 60);
    for (const camera of [this.perspective, this.parallel]) camera.up.set(...up);
    this.bind(new THREE.Vector3());
  }

  get camera(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.orthographic ? this.parallel : this.perspective;
  }

  /** The point around which it turns, scene. */
  get target(): THREE.Vector3 {
    return this.controls.target;
  }

  /** What is in the picture, in the coordinates of an object of the scene. */
  frustumOf(object: THREE.Object3D): THREE.Frustum {
    const { camera } = this;
    camera.updateMatrixWorld();
    object.updateWorldMatrix(true, false);
    const matrix = new THREE.Matrix4()
      .multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse)
      .multiply(object.matrixWorld);
    return new THREE.Frustum().setFromProjectionMatrix(matrix);
  }

  private bind(target: THREE.Vector3): void {
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.element);
    this.controls.target.copy(target);
    this.controls.zoomToCursor = true;
    this.controls.minZoom = 0.05;
    this.controls.maxZoom = 4 / this.closest;
    this.controls.minDistance = this.closest;
    this.controls.maxDistance = 30;
    this.controls.addEventListener('change', () => this.quiet || this.changed());
    this.controls.addEventListener('start', () => (this.fitted = null));
    this.controls.update();
  }

  /** A view that was fitted and not moved since is fitted again. */
  resize(width: number, height: number, insets: Insets): void {
    [this.width, this.tall] = [Math.max(1, width), Math.max(1, height)];
    this.aspect = this.width / this.tall;
    // If almost nothing is left free, the machine may as well be behind the controls.
    const narrow = width - insets.left - insets.right < 0.3 * width;
    const low = height - insets.top - insets.bottom < 0.3 * height;
    this.insets = {
      left: narrow ? 0 : insets.left,
      right: narrow ? 0 : insets.right,
      top: low ? 0 : insets.top,
      bottom: low ? 0 : insets.bottom,
    };
    this.perspective.aspect = this.aspect;
    this.perspective.updateProjectionMatrix();
    this.setFrustum();
    if (this.fitted) this.fit(this.fitted.half, this.fitted.back);
  }

  /** The target is in the middle of the free area. */
  private shift(): void {
    const { left, right, top, bottom } = this.insets;
    const [x, y] = [(right - left) / 2, (bottom - top) / 2];
    for (const camera of [this.perspective, this.parallel]) {
      camera.setViewOffset(this.width, this.tall, x, y, this.width, this.tall);
    }
  }

  private setFrustum(): void {
    const camera = this.parallel;
    camera.top = this.height / 2;
    camera.bottom = -camera.top;
    camera.right = camera.top * this.aspect;
    camera.left = -camera.right;
    this.shift();
  }

  /** Looks at the box (half edges about the origin) from direction `back` and fills the view. */
  fit(half: Triple, back?: Triple): void {
    const direction = back
      ? new THREE.Vector3(...back)
      : this.camera.position.clone().sub(this.controls.target);
    direction.normalize();
    // Exactly along `up` the view has no horizon; a tiny offset looks the same.
    const up = new THREE.Vector3(...this.up);
    if (Math.abs(direction.dot(up)) > 0.9999) {
      const aside = Math.abs(up.y) < 0.9 ? new THREE.Vector3(0, -1, 0) : new THREE.Vector3(0, 0, 1);
      direction.addScaledVector(aside, 1e-3).normalize();
    }
    const right = new THREE.Vector3().crossVectors(up, direction).normalize();
    const above = new THREE.Vector3().crossVectors(direction, right);
    const tangent = Math.tan(THREE.MathUtils.degToRad(kFieldOfView / 2));
    const { left, right: beside, top, bottom } = this.insets;
    const [across, upright] = [
      this.tall / Math.max(1, this.width - left - beside),
      this.tall / Math.max(1, this.tall - top - bottom),
    ];
    let distance = 0;
    let height = 0;
    for (let corner = 0; corner < 8; corner++) {
      const p = new THREE.Vector3(...half.map((h, i) => ((corner >> i) & 1 ? h : -h)));
      const x = Math.abs(p.dot(right)) * across;
      const y = Math.abs(p.dot(above)) * upright;
      distance = Math.max(distance, Math.max(x, y) / tangent + p.dot(direction));
      height = Math.max(height, 2 * x, 2 * y);
    }
    this.height = 1.12 * Math.max(height, 0.05);
    this.parallel.zoom = 1;
    this.setFrustum();
    this.controls.target.set(0, 0, 0);
    this.perspective.position.copy(direction).multiplyScalar(1.12 * Math.max(distance, 0.1));
    this.parallel.position.copy(direction).multiplyScalar(3);
    this.controls.update();
    this.fitted = { half, back };
    this.changed();
  }

  /** From the target to the camera, of length one. */
  get direction(): Triple {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  /** Brings the target nearer (`factor` above 1) or moves it away. */
  zoom(factor: number): void {
    this.fitted = null;
    if (this.orthographic) {
      this.parallel.zoom = Math.min(400, Math.max(0.05, this.parallel.zoom * factor));
      this.parallel.updateProjectionMatrix();
    } else {
      const { target } = this.controls;
      const away = this.perspective.position.clone().sub(target).divideScalar(factor);
      this.perspective.position.copy(target).add(away.clampLength(0.01, 30));
    }
    this.controls.update();
    this.changed();
  }

  /** Turns about the vertical and towards the zenith [rad]. */
  turn(aside: number, up: number): void {
    this.fitted = null;
    const { target } = this.controls;
    const axis = new THREE.Vector3(...this.up);
    const away = this.camera.position.clone().sub(target);
    const polar = away.angleTo(axis);
    const right = new THREE.Vector3().crossVectors(axis, away).normalize();
    const allowed = Math.min(polar - 0.01, Math.max(polar - Math.PI + 0.01, up));
    away.applyAxisAngle(right, -allowed).applyAxisAngle(axis, aside);
    this.camera.position.copy(target).add(away);
    this.controls.update();
    this.changed();
  }

  /** Moves the view to the right and up by fractions of its height. */
  move(aside: number, up: number): void {
    this.fitted = null;
    const { camera } = this;
    const { target } = this.controls;
    const tangent = Math.tan(THREE.MathUtils.degToRad(kFieldOfView / 2));
    const away = camera.position.distanceTo(target);
    const height = this.orthographic ? this.height / this.parallel.zoom : 2 * tangent * away;
    camera.updateMatrix();
    const [right, above] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(camera.matrix, k));
    const way = right!.multiplyScalar(aside * height).addScaledVector(above!, up * height);
    camera.position.add(way);
    target.add(way);
    this.controls.update();
    this.changed();
  }

  keep(): KeptCamera {
    return {
      orthographic: this.orthographic,
      height: this.height,
      zoom: this.parallel.zoom,
      position: this.camera.position.toArray(),
      target: this.controls.target.toArray(),
    };
  }

  /** Looks from where another page did. */
  adopt(kept: KeptCamera): void {
    if (kept.orthographic !== this.orthographic) this.setOrthographic(kept.orthographic);
    this.fitted = null;
    this.height = kept.height;
    this.parallel.zoom = kept.zoom;
    this.camera.position.fromArray(kept.position);
    this.controls.target.fromArray(kept.target);
    this.setFrustum();
    this.controls.update();
  }

  /** Takes the viewpoint of another camera of the same kind of view. */
  follow(other: CameraRig): void {
    this.quiet = true;
    this.fitted = null;
    if (other.orthographic !== this.orthographic) this.setOrthographic(other.orthographic);
    this.height = other.height;
    this.parallel.zoom = other.parallel.zoom;
    this.camera.position.copy(other.camera.position);
    this.controls.target.copy(other.controls.target);
    this.setFrustum();
    this.controls.update();
    this.quiet = false;
  }

  /** Changes the projection; objects at the target keep their size. */
  setOrthographic(on: boolean): void {
    if (on === this.orthographic) return;
    const target = this.controls.target.clone();
    const direction = this.camera.position.clone().sub(target);
    const tangent = Math.tan(THREE.MathUtils.degToRad(kFieldOfView / 2));
    if (on) {
      this.height = 2 * tangent * direction.length();
      this.parallel.zoom = 1;
      this.parallel.position.copy(target).addScaledVector(direction.normalize(), 3);
      this.setFrustum();
    } else {
      const distance = this.height / this.parallel.zoom / (2 * tangent);
      this.perspective.position.copy(target).addScaledVector(direction.normalize(), distance);
    }
    this.orthographic = on;
    this.bind(target);
    if (!this.quiet) this.changed();
  }
}
