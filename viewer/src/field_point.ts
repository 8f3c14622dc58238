import type { Body } from './run';
import type { FieldSource } from './fields';

/** The point at which the value of a body is requested. */
export interface FieldPoint {
  node: number;
  /** −1 if the point has none. */
  place: number;
  element: number;
  line: number;
  /** Of the line: 0 or 1. */
  end: number;
}

/** Index of a point among the places of a source, −1 if it is none of them. */
export function indexAt(of: FieldSource, point: FieldPoint): number {
  const { node, place, element, line, end } = point;
  const lineEnds = line < 0 ? -1 : 2 * line + end;
  return { nodes: node, places: place, elements: element, lines: line, lineEnds }[of.on];
}

/** Which end of a line a node is. */
export function endOf(body: Body, line: number, node: number): number {
  return line >= 0 && body.elements[line]![1] === node ? 1 : 0;
}

/** Any element and place that belong to a node, for nodes chosen by number. */
export function pointOf(body: Body, node: number): FieldPoint {
  const corner = body.faces ? body.faces.nodes.indexOf(node) : -1;
  const line = body.elements.findIndex((ends) => ends.includes(node));
  return {
    node,
    place: corner < 0 ? -1 : (body.faces!.places?.[corner] ?? -1),
    element: corner < 0 ? -1 : body.faces!.elements[corner >> 2]!,
    line,
    end: endOf(body, line, node),
  };
}
