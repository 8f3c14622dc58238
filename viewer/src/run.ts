import type { PageBody, PageData, PageJoint, PageMarker, Triple } from './page_data';

/** A body with its recorded motion. */
export interface Body {
  name: string;
  kind: 'rigid' | 'beam' | 'solid';
  nodes: Triple[];
  elements: [number, number][];
  radius: number[];
  /** Surface of solids: nodes counter-clockwise seen from outside, the fourth −1 for triangles. */
  faces: [number, number, number, number][];
  /** Per face the element of `solidStress` below it. */
  faceElements: number[];
  /** frames × elements with a face [Pa]. */
  solidStress: Float32Array | null;
  markers: PageMarker[];
  pose: Float32Array;
  displacement: Float32Array | null;
  stress: Float32Array | null;
  /** Pages with modes: frames × 6, motion of the frame; null in runs. */
  motion?: Float32Array | null;
  /** False for bars: no rotation was ever recorded, elements stay straight between their nodes. */
  hasRotations: boolean;
}

/** One recorded quantity; `values` is frames × components. */
export interface Series {
  name: string;
  unit: string;
  components: string[];
  values: Float32Array;
}

/** Everything the page shows, decoded and checked. */
export interface Run {
  title: string;
  version: string;
  generated: string;
  times: Float64Array;
  bodies: Body[];
  joints: PageJoint[];
  gravity: Triple;
  planar: 'xy' | 'yz' | 'zx' | null;
  sensors: Series[];
  energies: Series[];
  summary: Record<string, unknown>;
}

/** Largest stress of all bodies over the whole run [Pa]; 0 without stresses. */
export function largestStress(run: Run): number {
  let most = 0;
  for (const { stress, solidStress } of run.bodies) {
    for (const list of [stress, solidStress]) {
      list?.forEach((value) => {
        if (value > most) most = value;
      });
    }
  }
  return most;
}

/** The page holds something that cannot be shown; the message says what and where. */
export class PageDataError extends Error {}

/** Numbers of one base64 field. Throws PageDataError if the text or the count is wrong. */
export function decodeFloats(text: unknown, count: number, where: string): Float32Array {
  if (typeof text !== 'string') throw new PageDataError(`${where}: base64 text expected`);
  let raw: string;
  try {
    raw = atob(text);
  } catch {
    throw new PageDataError(`${where}: not valid base64`);
  }
  if (raw.length !== 4 * count) {
    throw new PageDataError(`${where}: ${raw.length / 4} numbers found, ${count} expected`);
  }
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  const view = new DataView(bytes.buffer);
  const floats = new Float32Array(count);
  for (let i = 0; i < count; i++) floats[i] = view.getFloat32(4 * i, true);
  return floats;
}

function decodeTimes(data: PageData): Float64Array {
  const n = data.time?.n;
  if (!Number.isInteger(n) || n < 0) throw new PageDataError('time.n: a count is expected');
  const times = Float64Array.from(decodeFloats(data.time.f32, n, 'time.f32'));
  for (let i = 1; i < n; i++) {
    if (!(times[i]! >= times[i - 1]!)) throw new PageDataError(`time: decreases at frame ${i}`);
  }
  return times;
}

const kKinds = ['rigid', 'beam', 'solid'] as const;

/** Rows of three translations as rows of six with rotations, all zero. */
function withRotations(translations: Float32Array): Float32Array {
  const out = new Float32Array(2 * translations.length);
  for (let i = 0; i < translations.length; i++) out[2 * i - (i % 3)] = translations[i]!;
  return out;
}

function decodeDisplacement(body: PageBody, frames: number, where: string): Float32Array | null {
  if (!body.displacement) return null;
  const count = frames * body.nodes.length;
  const translationsOnly = (body.faces ?? []).length > 0 && (body.elements ?? []).length === 0;
  if (translationsOnly) return withRotations(decodeFloats(body.displacement, 3 * count, where));
  return decodeFloats(body.displacement, 6 * count, where);
}

/** The surface of a solid body; empty for others. */
function decodeSurface(body: PageBody, frames: number, where: string) {
  const faces = body.faces ?? [];
  const faceElements = faces.map((_, f) => body.faceElements?.[f] ?? 0);
  for (const face of faces) {
    if (face.some((node, k) => !body.nodes[node] && !(k === 3 && node === -1))) {
      throw new PageDataError(`${where}.faces: no such node in [${face.join(', ')}]`);
    }
  }
  const count = faceElements.reduce((most, e) => Math.max(most, e + 1), 0);
  const solidStress = body.solidStress
    ? decodeFloats(body.solidStress, frames * count, `${where}.solidStress`)
    : null;
  return { faces, faceElements, solidStress };
}

function anyRotation(displacement: Float32Array): boolean {
  for (let i = 0; i < displacement.length; i += 6) {
    if (displacement[i + 3] !== 0 || displacement[i + 4] !== 0 || displacement[i + 5] !== 0) {
      return true;
    }
  }
  return false;
}

function decodeBody(body: PageBody, frames: number, where: string): Body {
  const nodes = body.nodes ?? [];
  const elements = body.elements ?? [];
  for (const [a, b] of elements) {
    if (!nodes[a] || !nodes[b]) throw new PageDataError(`${where}.elements: no node ${a} or ${b}`);
  }
  const displacement = decodeDisplacement(body, frames, `${where}.displacement`);
  return {
    name: body.name,
    kind: kKinds.find((kind) => kind === body.kind) ?? 'rigid',
    nodes,
    elements,
    radius: elements.map((_, e) => body.radius?.[e] ?? 0),
    ...decodeSurface(body, frames, where),
    markers: body.markers ?? [],
    pose: decodeFloats(body.pose, frames * 7, `${where}.pose`),
    displacement,
    stress: body.stress
      ? decodeFloats(body.stress, frames * elements.length, `${where}.stress`)
      : null,
    motion: body.motion ? decodeFloats(body.motion, frames * 6, `${where}.motion`) : null,
    hasRotations: displacement !== null && anyRotation(displacement),
  };
}

function checkJoint(joint: PageJoint, bodies: Body[], where: string): PageJoint {
  for (const side of joint.between ?? []) {
    if (side.body >= bodies.length) throw new PageDataError(`${where}: no body ${side.body}`);
  }
  if ((joint.between ?? []).length === 0) throw new PageDataError(`${where}: no side given`);
  return joint;
}

/** Decodes and checks the page's data; `null` (an unfilled page) is refused like any fault. */
export function decodeRun(data: PageData | null | undefined): Run {
  if (!data) throw new PageDataError('This page holds no run.');
  if (data.format !== 1) {
    throw new PageDataError(`format ${String(data.format)}: this page understands format 1`);
  }
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
  return {
    title: data.title || 'Untitled run',
    version: data.version ?? '',
    generated: data.generated ?? '',
    times,
    bodies,
    joints: (data.joints ?? []).map((joint, i) => checkJoint(joint, bodies, `joints[${i}]`)),
    gravity: data.gravity ?? [0, 0, 0],
    planar: planar === 'xy' || planar === 'yz' || planar === 'zx' ? planar : null,
    sensors: (data.sensors ?? []).map((s, i) => {
      const components = s.components?.length ? s.components : [''];
      return series(s.name, s.unit, components, s.values, `sensors[${i}]`);
    }),
    energies: (data.energies ?? []).map((e, i) =>
      series(e.name, e.unit, [''], e.values, `energies[${i}]`),
    ),
    summary: data.summary ?? {},
  };
}
