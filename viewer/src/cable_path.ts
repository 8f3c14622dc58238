import type { Triple } from './page_data';

/** What a cable passes: a pulley, radius negative where it runs around it clockwise, 0 at an end. */
export interface CablePlace {
  centre: Triple;
  radius: number;
}

const kAround = (2 * Math.PI) / 48;

const dot = (a: Triple, b: Triple) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const add = (a: Triple, b: Triple, s: number): Triple => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const cross = (a: Triple, b: Triple): Triple => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Unit vectors along a span and to its left, seen against the axis; null where it cannot be formed. */
function spanOf(from: CablePlace, to: CablePlace, axis: Triple): { along: Triple; left: Triple } | null {
  const apart = add(to.centre, from.centre, -1);
  const flat = add(apart, axis, -dot(axis, apart));
  const distance = Math.hypot(...flat);
  const q = to.radius - from.radius;
  if (!(distance > Math.abs(q))) return null;
  const length = Math.sqrt(distance * distance - q * q);
  const e = flat.map((x) => x / distance) as Triple;
  const across = cross(axis, e);
  // distance · e = length · along + q · left
  const along = add(e.map((x) => (x * length) / distance) as Triple, across, -q / distance);
  return { along, left: cross(axis, along) };
}

/** Angle by which a cable turns around a pulley, against the clock for a positive sense. */
function wrapBetween(arriving: Triple, leaving: Triple, sense: number, axis: Triple): number {
  const turn = sense * Math.atan2(dot(axis, cross(arriving, leaving)), dot(arriving, leaving));
  return turn < -1e-6 ? turn + 2 * Math.PI : turn;
}

/**
 * Points along a cable: straight between pulleys, arcs around them. A closed one ends where it begins.
 * @param axis unit vector, of all pulleys
 */
export function cablePath(places: CablePlace[], closed: boolean, axis: Triple): Triple[] {
  const count = places.length;
  const spans = places.slice(0, closed ? count : count - 1).map((from, k) => spanOf(from, places[(k + 1) % count]!, axis));
  const out: Triple[] = [];
  places.forEach((place, k) => {
    const leaving = spans[k] ?? null;
    const arriving = k > 0 || closed ? (spans[(k + count - 1) % count] ?? null) : null;
    const { centre, radius } = place;
    const span = arriving ?? leaving;
    if (radius === 0 || !span) {
      out.push(centre);
      return;
    }
    // Fixed to a drum, it goes around it once more; one that leaves it has come around before.
    const isDrum = !arriving || !leaving;
    const sense = Math.sign(radius);
    const wrap = isDrum ? 2 * Math.PI : wrapBetween(arriving!.along, leaving!.along, sense, axis);
    const steps = Math.max(1, Math.ceil(wrap / kAround));
    for (let i = 0; i <= steps; i++) {
      const angle = (sense * wrap * i) / steps;
      // The cable leaves the centre on its left where it runs counter-clockwise.
      const radial = add(
        span.left.map((x) => -x * radius * Math.cos(angle)) as Triple,
        span.along,
        radius * Math.sin(angle),
      );
      out.push(add(centre, radial, 1));
    }
  });
  if (closed && out.length > 0) out.push(out[0]!);
  return out;
}
