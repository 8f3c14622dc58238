/** The JSON that `buckens view` puts into the page, format 2. SI units throughout. */

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

/**
 * One row of numbers per frame. `f32`: plain. `u16`: codes 0 … 65534 over the range (least,
 * largest) of their row, 65535 for a missing number.
 */
export interface PageRows {
  type: 'f32' | 'u16';
  values: Base64;
  /** frames × 2 float32, for codes only. */
  ranges?: Base64;
}

/** A recorded quantity of a body. */
export interface PageField {
  /** Name as in results.h5: "von_mises", "stress" … */
  name: string;
  unit: string;
  /** Names of the numbers at one place; one empty name for a scalar. */
  components: string[];
  /**
   * What has a value: `places` of the surface (`facePlaces`), `elements` with a face, `lines`
   * (`elements` of the body), `lineEnds`: first and second end of each line.
   */
  on: 'places' | 'elements' | 'lines' | 'lineEnds';
  /** Side of a shell: "top", "layer 2, bottom". */
  level?: string;
  /** True if one row applies to the whole run. */
  constant?: boolean;
  /** frames × places × components. */
  values: PageRows;
  /** Frame of each row as int32, if not every frame has one. */
  frames?: Base64;
}

export interface PageBody {
  name: string;
  kind: 'rigid' | 'beam' | 'solid';
  /** Nodes × 3, body frame, undeformed [m]. The origin is the mass centre. */
  nodes: Base64;
  /** Number of each node in the run as int32; missing if they are 0, 1, 2 … */
  nodeNumbers?: Base64 | null;
  elements: [number, number][];
  /** Radius of the drawn tube at both ends of each element [m]. */
  radius: [number, number][];
  /**
   * Cross-sections of the elements, each as base64 of points y, z [m]: the outline, which turns from
   * y to z, then those of holes, which turn the other way. Missing in runs of older versions.
   */
  sections?: Base64[][] | null;
  /** Elements × 2 as int32: section at both ends. */
  elementSections?: Base64;
  /** Elements × 3 as float32: local y axis in the body frame; x runs along the element, z = x × y. */
  elementAxes?: Base64;
  markers: PageMarker[];
  /** frames × 7: position, then unit quaternion w, x, y, z. */
  pose: Base64;
  /**
   * Surface of solids, faces × 4 as int32: nodes counter-clockwise seen from outside, the fourth −1
   * for triangles.
   */
  faces?: Base64;
  /** Element below each face as int32, counted among those that have a face. */
  faceElements?: Base64;
  /**
   * Per face as int32 which of its sides are edges of its element: bit k for that from corner k to the
   * next. Faces of quadratic elements fall into pieces. Null where all are.
   */
  faceEdges?: Base64 | null;
  /** Faces × 4 as int32: the place of fields on `places` at each corner, −1 if it has none. */
  facePlaces?: Base64 | null;
  /**
   * frames × nodes × 6: translations [m] and rotations [rad] in the body frame; × 3 without the
   * rotations for solids without beams or bars.
   */
  displacement: PageRows | null;
  /** Pages with modes: frames × 6, rotation of the body frame in its axes [rad], translation [m]. */
  motion?: Base64 | null;
  fields?: PageField[];
}

export interface PageJointSide {
  /** Index into bodies, −1 for the ground. */
  body: number;
  /** Index into the body's markers, −1 if `position` alone defines the place. */
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
  /** frames × 3, on the last side in world axes [N]; null if not recorded. */
  force?: Base64 | null;
  /** frames × 3, on the last side about its origin, in world axes [N m]. */
  torque?: Base64 | null;
}

/** A shape that bodies touch, roll or are guided with. */
export interface PageShape {
  /** Of its contact, joint or load. */
  name: string;
  kind: 'plane' | 'sphere' | 'socket' | 'bore' | 'capsule' | 'cylinder' | 'box' | 'mesh' | 'wheel' | 'curve' | 'cam';
  on: PageJointSide;
  /** w, x, y, z: axes of the shape in those of the body. */
  orientation: [number, number, number, number];
  /** Of planes and long shapes, own axes. */
  axis: Triple;
  radius: number;
  length: number;
  /** Edges of boxes; of meshes and curves twice their reach [m]. */
  size: Triple;
  /** Of meshes and curves: points × 3 as float32; corners of triangles × 3 as int32, of curves none. */
  points?: Base64;
  triangles?: Base64;
}

/** A cable or belt over pulleys. */
export interface PageCable {
  name: string;
  kind: string;
  closed: boolean;
  /** Side in whose body the axis stands. */
  firstPulley: number;
  axis: Triple;
  sides: PageJointSide[];
  /** One per side; negative: it runs around clockwise, 0: it ends there. */
  radii: number[];
}

/** A load to be drawn as arrows. */
export interface PageLoad {
  name: string;
  /** "force", "torque", "pressure" … */
  kind: string;
  /** Index into bodies, −1 for the ground. */
  body: number;
  /** Directions turn with the body. */
  follows: boolean;
  unit: string;
  /** Feet of the arrows in the body frame, undeformed [m]. */
  positions: Triple[];
  /** Node that carries each foot, −1 if none. */
  nodes: number[];
  /** Unit vectors for a value of one, body axes; may be missing where values have three numbers. */
  directions: Triple[];
  /** frames × 1: factor of the directions; frames × 3: vector in their place; null if not recorded. */
  values: Base64 | null;
  /** Numbers per frame: 1, 3, or 0 without values. */
  width: number;
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

/** Vibrations: every frame is the shape of one mode, `time` counts them from 1. */
export interface PageMode {
  label: string;
  /** [Hz] */
  frequency: number;
  /** Generalised mass of the shape, whose largest displacement is 1 m [kg]. */
  mass: number;
}

/** What the page contains of the run. */
export interface PageStorage {
  /** Records in the run; the page has `time.n` of them. */
  records: number;
  /** Fields and displacements are rounded to 16 bits. */
  rounded: boolean;
  /** Why frames were left out, and other things to know; sentences. */
  notes: string[];
}

export interface PageRun {
  title: string;
  /** Name of the run directory; missing in pages of older versions. */
  directory?: string;
  /** What was changed by --set: "bodies.rod.beam.elements=32". */
  changes?: string[];
  version: string;
  generated: string;
  time: { n: number; f32: Base64 };
  bodies: PageBody[];
  joints: PageJoint[];
  loads?: PageLoad[];
  /** Missing in pages of older versions, as are cables. */
  shapes?: PageShape[];
  cables?: PageCable[];
  gravity: Triple;
  planar: string | null;
  sensors: PageSensor[];
  energies: PageEnergy[];
  summary: Record<string, unknown>;
  /** Missing in pages of runs. */
  modes?: PageMode[] | null;
  storage?: PageStorage;
}

/** One run, or two side by side. */
export interface PageData {
  format: number;
  runs: PageRun[];
}
