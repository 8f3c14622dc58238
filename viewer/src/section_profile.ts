/** Cross-sections as rings of vertices: what a beam is swept from. */

/** A closed polygon of points y, z; outlines turn from y to z, holes the other way round. */
export type Loop = [number, number][];

/** Corners that turn less than this look smooth: cos 40°. */
const kSmooth = 0.766;

/** The vertices around a section. Sharp corners have two, one for each side. */
export interface Profile {
  /** For each vertex: y, z. */
  points: [number, number][];
  /** For each vertex: unit normal out of the material. */
  normals: [number, number][];
  /** Pairs of neighbouring vertices, the material on their left. */
  sides: [number, number][];
  /** Triangles that close the section, counter-clockwise seen against x; vertex indices. */
  cap: [number, number, number][];
  /** Radius of the enclosing circle about the centroid. */
  radius: number;
  /** Distance of the outline from the centroid: of the largest circle inside. */
  inside: number;
}

/** A circle as a polygon. */
export function circle(radius: number, sides: number): Loop {
  return [...Array(sides)].map((_, i) => {
    const angle = (2 * Math.PI * i) / sides;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

function normalOf(a: [number, number], b: [number, number]): [number, number] {
  const [y, z] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(y, z) || 1;
  return [z / length, -y / length];
}

/** Adds a loop, `round` or with corners; returns its first vertex at each of its points. */
function addLoop(loop: Loop, round: boolean, to: Profile): number[] {
  const n = loop.length;
  const outwards = loop.map((p, i) => normalOf(p, loop[(i + 1) % n]!));
  const [before, after] = [new Array<number>(n), new Array<number>(n)];
  const add = (point: [number, number], normal: [number, number]) => {
    to.points.push(point);
    to.normals.push(normal);
    return to.points.length - 1;
  };
  loop.forEach((point, i) => {
    const [a, b] = [outwards[(i + n - 1) % n]!, outwards[i]!];
    if (round || a[0] * b[0] + a[1] * b[1] > kSmooth) {
      const length = Math.hypot(a[0] + b[0], a[1] + b[1]);
      before[i] = after[i] = add(point, [(a[0] + b[0]) / length, (a[1] + b[1]) / length]);
    } else {
      before[i] = add(point, a);
      after[i] = add(point, b);
    }
  });
  loop.forEach((_, i) => to.sides.push([after[i]!, before[(i + 1) % n]!]));
  return before;
}

/** Closes an outline, with or without a hole of the same number of corners inside. */
function capOf(outline: number[], hole: number[] | undefined): Profile['cap'] {
  const n = outline.length;
  const cap: Profile['cap'] = [];
  if (hole?.length === n) {
    // The hole runs the other way round.
    const inner = [...hole].reverse();
    outline.forEach((a, i) => {
      const [b, c, d] = [outline[(i + 1) % n]!, inner[(i + 1) % n]!, inner[i]!];
      cap.push([a, b, c], [a, c, d]);
    });
    return cap;
  }
  for (let i = 2; i < n; i++) cap.push([outline[0]!, outline[i - 1]!, outline[i]!]);
  return cap;
}

/** Least distance of the origin from the sides of a polygon around it. */
function insideOf(loop: Loop): number {
  const distances = loop.map((p, i) => {
    const normal = normalOf(p, loop[(i + 1) % loop.length]!);
    return normal[0] * p[0] + normal[1] * p[1];
  });
  return Math.max(0, Math.min(...distances));
}

function isRound(loop: Loop): boolean {
  return loop.length >= 16;
}

/** Every `step`-th corner of smooth loops, of holes those opposite; the others as they are. */
function thinned(loop: Loop, step: number, hole: boolean): Loop {
  if (!isRound(loop) || step <= 1) return loop;
  return loop.filter((_, i) => i % step === (hole ? step - 1 : 0));
}

/**
 * `step` above 1 leaves out corners of round loops; `round` says that all of them are. Convex outlines
 * are expected.
 */
export function profileOf(loops: Loop[], step = 1, round = false): Profile {
  const profile: Profile = { points: [], normals: [], sides: [], cap: [], radius: 0, inside: 0 };
  const firsts = loops.map((loop, i) =>
    addLoop(thinned(loop, step, i > 0), round || isRound(loop), profile),
  );
  profile.cap = capOf(firsts[0] ?? [], firsts[1]);
  profile.radius = Math.max(0, ...profile.points.map(([y, z]) => Math.hypot(y, z)));
  const smooth = profile.points.length === profile.sides.length;
  profile.inside = smooth ? profile.radius : insideOf(loops[0] ?? []);
  return profile;
}
