import { FieldValues } from './field_values';
import { sourcesOf, type FieldSource } from './fields';
import type { FramePlace } from './interpolation';
import type { Body } from './run';
import type { Painted } from './surface_values';

/** The fields of one body, computed where they are needed. */
export class BodyField {
  private readonly sources: FieldSource[];
  private readonly known = new Map<FieldSource, FieldValues>();

  constructor(readonly body: Body) {
    this.sources = sourcesOf(body);
  }

  /** Where the values of an item come from on the lines, or on the surface, of the body. */
  source(item: string, lines: boolean, perElement: boolean): FieldSource | null {
    const order = lines
      ? ['lines', 'lineEnds', 'nodes']
      : perElement
        ? ['elements', 'places', 'nodes']
        : ['places', 'nodes', 'elements'];
    for (const on of order) {
      const found = this.sources.find((s) => s.item.id === item && s.on === on);
      if (found) return found;
    }
    return null;
  }

  at(item: string, lines: boolean, perElement: boolean, place: FramePlace): Painted | null {
    const source = this.source(item, lines, perElement);
    if (!source) return null;
    let values = this.known.get(source);
    if (!values) this.known.set(source, (values = new FieldValues(source)));
    return { on: source.on, values: values.at(place) };
  }
}
