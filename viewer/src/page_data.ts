/** The JSON that `buckens view` puts into the page, format 1. SI units throughout. */

export type Triple = [number, number, number];

/** Numbers as base64 of little-endian float32, row after row. */
export type Base64 = string;

export interface PageMarker {
  name: string;
  /** Body frame, undeformed [m]. */
  position: Triple;
  /** Unit quaternion w, x, y, z: marker axes in the body frame. */
  orientation: [number, number, number, number];
  /** Node that carries the marker, −1 on a rigid body. */
  node: number;
}

export interface PageBody {
  name: string;
  kind: 'rigid' | 'beam' | 'solid';
  /** Body frame, undeformed [m]. The origin is the mass centre. */
  nodes: Triple[];
  elements: [number, number][];
  /** Radius of the drawn tube per element [m]. */
  radius: number[];
  markers: PageMarker[];
  /** frames × 7: position, then unit quaternion w, x, y, z. */
  pose: Base64;
  /** Surface of solids: nodes counter-clockwise seen from outside, the fourth −1 for triangles. */
  faces?: [number, number, number, number][];
  /** Per face the element below it, counted among those that have a face. */
  faceElements?: number[];
  /** frames × elements with a face: von Mises stress at the centre [Pa]. */
  solidStress?: Base64 | null;
  /**
   * frames × nodes × 6: translations [m] and rotations [rad] in the body frame; × 3 without the
   * rotations for solids without beams or bars.
   */
  displacement: Base64 | null;
  /** Pages with modes: frames × 6, rotation of the body frame in its axes [rad], translation [m]. */
  motion?: Base64 | null;
  /** frames × elements: largest |stress| in the element [Pa]. */
  stress: Base64 | null;
}

export interface PageJointSide {
  /** Index into bodies, −1 for the ground. */
  body: number;
  /** Index into the body's markers, −1 where `position` alone says it. */
  marker: number;
  /** Frame of the body (world for the ground) [m]. */
  position: Triple;
}

export interface PageJoint {
  name: string;
  type: string;
  between: PageJointSide[];
  /** Unit vector along the axes of the first side's body, of the world for the ground. */
  axis: Triple;
}

export interface PageSensor {
  name: string;
  unit: string;
  components: string[];
  values: Base64;
}

export interface PageEnergy {
  name: string;
  unit: string;
  values: Base64;
}

/** Vibrations: every frame is the shape of one of them, `time` counts them from 1. */
export interface PageMode {
  label: string;
  /** [Hz] */
  frequency: number;
  /** Generalised mass of the shape, whose largest displacement is 1 m [kg]. */
  mass: number;
}

export interface PageData {
  format: number;
  title: string;
  version: string;
  generated: string;
  time: { n: number; f32: Base64 };
  bodies: PageBody[];
  joints: PageJoint[];
  gravity: Triple;
  planar: string | null;
  sensors: PageSensor[];
  energies: PageEnergy[];
  summary: Record<string, unknown>;
  /** Missing in pages of runs. */
  modes?: PageMode[] | null;
}
