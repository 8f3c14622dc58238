import { decodeFloats, decodeInts, PageDataError } from './base64';
import { decodeFaces, decodeSections, type Faces, type Sections } from './body_shape';
import { PackedRows, SparseRows, type Rows } from './rows';
import type {
  PageBody,
  PageCable,
  PageData,
  PageField,
  PageJoint,
  PageLoad,
  PageMarker,
  PageRun,
  PageShape,
  PageStorage,
  Triple,
} from './page_data';

export { decodeFloats, PageDataError };
export type { Faces, Sections };

/** A recorded quantity of a body. */
export interface Field {
  name: string;
  unit: string;
  components: string[];
  on: PageField['on'];
  /** Side of a shell; empty without one. */
  level: string;
  constant: boolean;
  /** Row: places × components. */
  rows: Rows;
}

/** A body with its recorded motion. */
export interface Body {
  name: string;
  kind: 'rigid' | 'beam' | 'solid';
  /** Nodes × 3. */
  nodes: Float32Array;
  /** Number of each node in the run; null if it is the same. */
  nodeNumbers: Int32Array | null;
  elements: [number, number][];
  /** At both ends of each element. */
  radius: [number, number][];
  /** Null if beams are drawn as round tubes of this radius. */
  sections: Sections | null;
  /** Null for bodies without a surface. */
  faces: Faces | null;
  markers: PageMarker[];
  pose: Float32Array;
  displacement: Rows | null;
  /** Numbers of `displacement` per node: 3, or 6 with rotations. */
  perNode: 3 | 6;
  /** Vibrations: displacement of the nodes, body axes, relative to the largest of the model; null in runs. */
  shape: Rows | null;
  /** Pages with modes: frames × 6, motion of the frame; null in runs. */
  motion: Float32Array | null;
  fields: Field[];
  /** False for bars: no rotation was ever recorded, elements stay straight between their nodes. */
  hasRotations: boolean;
}

/** A load with its recorded values, `width` per frame. */
export interface Load extends Omit<PageLoad, 'values'> {
  values: Float32Array | null;
}

/** A shape of contact; meshes with their points × 3 and corners × 3. */
export interface Shape extends Omit<PageShape, 'points' | 'triangles'> {
  points: Float32Array | null;
  triangles: Int32Array | null;
}

export type Cable = PageCable;

/** A joint with its force and torque on the last side, frames × 3. */
export interface Joint extends Omit<PageJoint, 'force' | 'torque'> {
  force: Float32Array | null;
  torque: Float32Array | null;
}

/** One recorded quantity; `values` is frames × components. */
export interface Series {
  name: string;
  unit: string;
  components: string[];
  values: Float32Array;
}

/** What the page contains of the run. */
export interface Storage extends PageStorage {
  /** Frames in the page. */
  shown: number;
  /** Each of them is the shape of a vibration. */
  vibrations: boolean;
}

/** Everything the page shows of a run, decoded and checked. */
export interface Run {
  title: string;
  /** Name of its directory; empty if the page does not know it. */
  directory: string;
  /** Overrides by --set. */
  changes: string[];
  version: string;
  generated: string;
  times: Float64Array;
  /** Unit of `times`: a static path counts the length of the path in steps. */
  clock: 's' | 'steps';
  bodies: Body[];
  joints: Joint[];
  loads: Load[];
  shapes: Shape[];
  cables: Cable[];
  gravity: Triple;
  planar: 'xy' | 'yz' | 'zx' | null;
  sensors: Series[];
  energies: Series[];
  summary: Record<string, unknown>;
  storage: Storage;
}

export function numNodes(body: Body): number {
  return body.nodes.length / 3;
}

/** Undeformed position of a node in the body frame [m]. */
export function nodeAt(body: Body, node: number): Triple {
  return [body.nodes[3 * node]!, body.nodes[3 * node + 1]!, body.nodes[3 * node + 2]!];
}

/** What the run calls the node. */
export function nodeNumber(body: Body, node: number): number {
  return body.nodeNumbers?.[node] ?? node;
}

/** The node that the run calls `number`, −1 if it is not in the page. */
export function nodeNumbered(body: Body, number: number): number {
  if (body.nodeNumbers) return body.nodeNumbers.indexOf(number);
  return Number.isInteger(number) && number >= 0 && number < numNodes(body) ? number : -1;
}

function decodeTimes(data: PageRun): Float64Array {
  const n = data.time?.n;
  if (!Number.isInteger(n) || n < 0) throw new PageDataError('time.n: a count is expected');
  const times = Float64Array.from(decodeFloats(data.time.f32, n, 'time.f32'));
  for (let i = 1; i < n; i++) {
    if (!(times[i]! >= times[i - 1]!)) throw new PageDataError(`time: decreases at frame ${i}`);
  }
  return times;
}

const kKinds = ['rigid', 'beam', 'solid'] as const;

function decodeField(field: PageField, frames: number, count: number, where: string): Field {
  const components = field.components?.length ? field.components : [''];
  const { name, unit, on, constant = false } = field;
  const width = count * components.length;
  const at = field.frames ? decodeInts(field.frames, 1, `${where}.frames`) : null;
  const packed = new PackedRows(field.values, width, constant ? 1 : (at?.length ?? frames), where);
  const rows = at ? new SparseRows(packed, at, frames) : packed;
  return { name, unit: unit ?? '', on, level: field.level ?? '', components, constant, rows };
}

/** Frames that are searched for rotations. */
const kSearched = 20;

/** Whether any node turns; rotations of bars are zero up to rounding. */
function anyRotation(rows: PackedRows): boolean {
  const row = new Float32Array(rows.width);
  const step = Math.max(1, Math.floor(rows.frames / kSearched));
  for (let index = rows.frames - 1; index >= 0; index -= step) {
    rows.interpolate({ index, fraction: 0 }, row);
    const grain = rows.grain(index);
    for (let i = 3; i < row.length; i += 6) {
      for (let k = 0; k < 3; k++) if (Math.abs(row[i + k]!) > grain) return true;
    }
  }
  return false;
}

function decodeBody(body: PageBody, frames: number, where: string): Body {
  const bits = decodeInts(body.nodes ?? '', 3, `${where}.nodes`);
  const nodes = new Float32Array(bits.buffer, 0, bits.length);
  const count = nodes.length / 3;
  const elements = body.elements ?? [];
  for (const [a, b] of elements) {
    const known = [a, b].every((node) => node >= 0 && node < count);
    if (!known) throw new PageDataError(`${where}.elements: no node ${a} or ${b}`);
  }
  const faces = decodeFaces(body, count, where);
  const perNode = faces && elements.length === 0 ? 3 : 6;
  const displacement = body.displacement
    ? new PackedRows(body.displacement, perNode * count, frames, `${where}.displacement`)
    : null;
  const numbers = body.nodeNumbers ? decodeInts(body.nodeNumbers, 1, `${where}.nodeNumbers`) : null;
  if (numbers && numbers.length !== count) throw new PageDataError(`${where}.nodeNumbers: wrong count`);
  const size = {
    places: faces?.numPlaces,
    elements: faces?.numElements,
    lines: elements.length,
    lineEnds: 2 * elements.length,
  };
  return {
    name: body.name,
    kind: kKinds.find((kind) => kind === body.kind) ?? 'rigid',
    nodes,
    nodeNumbers: numbers,
    elements,
    radius: elements.map((_, e) => body.radius?.[e] ?? [0, 0]),
    sections: decodeSections(body, elements.length, where),
    faces,
    markers: body.markers ?? [],
    pose: decodeFloats(body.pose, frames * 7, `${where}.pose`),
    displacement,
    perNode,
    shape: null,
    motion: body.motion ? decodeFloats(body.motion, frames * 6, `${where}.motion`) : null,
    fields: (body.fields ?? []).map((field) =>
      decodeField(field, frames, size[field.on] ?? 0, `${where}.${field.name}`),
    ),
    hasRotations: displacement !== null && perNode === 6 && anyRotation(displacement),
  };
}

function decodeJoint(joint: PageJoint, bodies: Body[], frames: number, where: string): Joint {
  for (const side of joint.between ?? []) {
    if (side.body >= bodies.length) throw new PageDataError(`${where}: no body ${side.body}`);
  }
  if ((joint.between ?? []).length === 0) throw new PageDataError(`${where}: no side given`);
  const vector = (text: string | null | undefined, name: string) =>
    text ? decodeFloats(text, 3 * frames, `${where}.${name}`) : null;
  return { ...joint, force: vector(joint.force, 'force'), torque: vector(joint.torque, 'torque') };
}

function decodeLoad(load: PageLoad, bodies: Body[], frames: number, where: string): Load {
  if (load.body >= bodies.length) throw new PageDataError(`${where}: no body ${load.body}`);
  const width = load.values ? load.width : 0;
  const values = load.values ? decodeFloats(load.values, frames * width, `${where}.values`) : null;
  return { ...load, nodes: load.positions.map((_, i) => load.nodes?.[i] ?? -1), width, values };
}

function decodeShape(shape: PageShape, bodies: Body[], where: string): Shape {
  if (shape.on.body >= bodies.length) throw new PageDataError(`${where}: no body ${shape.on.body}`);
  if (!shape.points) return { ...shape, points: null, triangles: null };
  const bits = decodeInts(shape.points, 3, `${where}.points`);
  const points = new Float32Array(bits.buffer, 0, bits.length);
  if (!shape.triangles) return { ...shape, points, triangles: null };
  const triangles = decodeInts(shape.triangles, 3, `${where}.triangles`);
  if (triangles.some((corner) => corner < 0 || 3 * corner >= points.length)) {
    throw new PageDataError(`${where}.triangles: a point is missing`);
  }
  return { ...shape, points, triangles };
}

function decodeCable(cable: PageCable, bodies: Body[], where: string): Cable {
  for (const side of cable.sides) {
    if (side.body >= bodies.length) throw new PageDataError(`${where}: no body ${side.body}`);
  }
  if (cable.radii.length !== cable.sides.length || !cable.sides[cable.firstPulley]) {
    throw new PageDataError(`${where}: sides and radii do not agree`);
  }
  return cable;
}

/** Decodes and checks one run of the page. */
export function decodeRun(data: PageRun): Run {
  const times = decodeTimes(data);
  const n = times.length;
  const bodies = (data.bodies ?? []).map((body, i) => decodeBody(body, n, `bodies[${i}]`));
  const series = (name: string, unit: string, components: string[], text: string, at: string) => ({
    name,
    unit: unit ?? '',
    components,
    values: decodeFloats(text, n * components.length, `${at}.values`),
  });
  const planar = data.planar;
  const summary = data.summary ?? {};
  return {
    title: data.title || 'Untitled run',
    directory: data.directory ?? '',
    changes: data.changes ?? [],
    version: data.version ?? '',
    generated: data.generated ?? '',
    times,
    clock: 'static_path' in summary ? 'steps' : 's',
    bodies,
    joints: (data.joints ?? []).map((joint, i) => decodeJoint(joint, bodies, n, `joints[${i}]`)),
    loads: (data.loads ?? []).map((load, i) => decodeLoad(load, bodies, n, `loads[${i}]`)),
    shapes: (data.shapes ?? []).map((shape, i) => decodeShape(shape, bodies, `shapes[${i}]`)),
    cables: (data.cables ?? []).map((cable, i) => decodeCable(cable, bodies, `cables[${i}]`)),
    gravity: data.gravity ?? [0, 0, 0],
    planar: planar === 'xy' || planar === 'yz' || planar === 'zx' ? planar : null,
    sensors: (data.sensors ?? []).map((s, i) => {
      const components = s.components?.length ? s.components : [''];
      return series(s.name, s.unit, components, s.values, `sensors[${i}]`);
    }),
    energies: (data.energies ?? []).map((e, i) =>
      series(e.name, e.unit, [''], e.values, `energies[${i}]`),
    ),
    summary,
    storage: {
      ...(data.storage ?? { records: n, rounded: false, notes: [] }),
      shown: n,
      vibrations: Boolean(data.modes),
    },
  };
}

/** The runs of the page; `null` (an unfilled page) is refused like any other fault. */
export function checkPage(data: PageData | null | undefined): PageRun[] {
  if (!data) throw new PageDataError('This page holds no run.');
  if (data.format !== 2) {
    throw new PageDataError(`format ${String(data.format)}: this page understands format 2`);
  }
  const runs = data.runs ?? [];
  if (runs.length < 1 || runs.length > 2) throw new PageDataError(`runs: ${runs.length} found, 1 or 2 expected`);
  return runs;
}
