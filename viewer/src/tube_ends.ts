import { dot, type BeamCurve } from './beam_curve';
import type { Body } from './run';

/** Radii that differ by more than this fraction form a step. */
const kStep = 1e-6;
/** Up to this bend two beams are mitred, beyond it a ball closes the gap: cos 100°. */
const kMitred = -0.174;

/** An end of an element: 2 · element for the first, one more for the second. */
export type End = number;

/** Direction out of the element at this end. */
export function outwards(end: End): number {
  return end % 2 ? 1 : -1;
}

export interface NodeEnds {
  /** Nodes at which beams end or change their section. */
  open: Set<number>;
  /** Nodes with a branch or a sharp bend. */
  kinks: number[];
  /** Pairs of ends at which one beam continues as the other. */
  joins: [End, End][];
}

/** Whether all the ends have the same section there. */
function sameSection(body: Body, ends: End[]): boolean {
  const radii = ends.map((end) => body.radius[end >> 1]![end % 2]!);
  const least = Math.min(...radii);
  if (Math.max(...radii) - least > kStep * least) return false;
  const { sections } = body;
  return !sections || ends.every((end) => sections.at[end] === sections.at[ends[0]!]);
}

export function nodeEnds(body: Body, curves: BeamCurve[]): NodeEnds {
  const at = new Map<number, End[]>();
  body.elements.forEach((nodes, e) => {
    nodes.forEach((node, k) => {
      const known = at.get(node);
      if (known) known.push(2 * e + k);
      else at.set(node, [2 * e + k]);
    });
  });
  const found: NodeEnds = { open: new Set(), kinks: [], joins: [] };
  for (const [node, ends] of at) {
    if (ends.length === 1 || !sameSection(body, ends)) found.open.add(node);
    if (ends.length === 1) continue;
    const [a, b] = [ends[0]!, ends[1]!];
    const along = dot(curves[a >> 1]!.axis, curves[b >> 1]!.axis);
    const straight = -outwards(a) * outwards(b) * along;
    if (ends.length === 2 && straight > kMitred) found.joins.push([a, b]);
    else found.kinks.push(node);
  }
  return found;
}
