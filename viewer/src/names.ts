import { numNodes } from './run';
import type { Label } from './labels';
import type { Motion } from './motion';
import type { Theme } from './theme';
import type { ViewOptions } from './view_options';
import type { Triple } from './page_data';

/** More names at once cannot be read. */
export const kMostNames = 80;

/** At most so many of a list, evenly spread. */
export function spread<T>(list: T[], most: number): T[] {
  const step = Math.ceil(list.length / most);
  return step <= 1 ? list : list.filter((_, i) => i % step === 0);
}

/** A point of the scene with a label. */
export interface Name extends Omit<Label, 'x' | 'y'> {
  /** World [m]. */
  at: Triple;
}

/** A drawn object with a name of its own; null if it has no position. */
export interface NamedGlyph {
  readonly name: string;
  position(scale: number): Triple | null;
}

/** Labels of bodies, joints, loads and markers, if the objects themselves are shown. */
export function namesOf(
  motion: Motion,
  glyphs: { joints: NamedGlyph[]; loads: NamedGlyph[] },
  theme: Theme,
  options: ViewOptions,
): Name[] {
  const names: Name[] = [];
  motion.bodies.forEach((body, i) => {
    const middle = body.body.elements.length > 0 && body.body.kind === 'beam';
    const at = middle ? body.node(Math.floor(numNodes(body.body) / 2), options.scale) : [0, 0, 0];
    const color = theme.bodies[i % theme.bodies.length]!;
    names.push({ text: body.body.name, kind: 'body', color, at: body.toWorld(at) });
  });
  for (const kind of ['joints', 'loads'] as const) {
    if (!options[kind]) continue;
    for (const glyph of glyphs[kind]) {
      const at = glyph.position(options.scale);
      if (at) names.push({ text: glyph.name, kind: 'joint', at });
    }
  }
  if (!options.frames) return names;
  for (const body of motion.bodies) {
    for (const marker of body.body.markers) {
      const at = body.toWorld(body.marker(marker, options.scale));
      names.push({ text: `${body.body.name}/${marker.name}`, kind: 'marker', at });
    }
  }
  return names;
}
