import * as THREE from 'three';
import { BodyField } from './body_field';
import { endOf, indexAt, pointOf, type FieldPoint } from './field_point';
import { history } from './field_values';
import type { FieldSource } from './fields';
import { nodeNumber, numNodes, type Body, type Run } from './run';
import type { BodyView } from './body_view';
import type { Skin } from './skin';

/** A node that the user follows. */
export interface Pick extends FieldPoint {
  /** Index among the runs side by side. */
  pane: number;
  body: number;
}

/** Whether what was hit is cut away by a section, or hidden by a limit of the field. */
function isAway(hit: THREE.Intersection, { mesh }: Skin): boolean {
  const { material, geometry } = mesh;
  const planes: THREE.Plane[] = material.clippingPlanes ?? [];
  if (planes.some((plane) => plane.distanceToPoint(hit.point) < 0)) return true;
  const field = geometry.getAttribute('fieldValue');
  const { a, b, c } = hit.face!;
  const values = [a, b, c].map((vertex) => field.getX(vertex));
  return material.hides(values, hit.barycoord!.toArray());
}

/** Closest visible vertex under the ray (scene units); null for none. */
export function pickAlong(ray: THREE.Raycaster, views: (BodyView | null)[]): Omit<Pick, 'pane'> | null {
  let least = Infinity;
  let best: Omit<Pick, 'pane'> | null = null;
  views.forEach((view, body) => {
    for (const skin of view?.skins ?? []) {
      const hit = ray.intersectObject(skin.mesh, false).find((one) => !isAway(one, skin));
      if (!hit || hit.distance >= least) continue;
      const picked = skin.vertex(nearestCorner(hit, skin.mesh), hit.faceIndex!);
      const { node, place, element, line } = picked;
      const known = pointOf(view!.field.body, node);
      best = { ...known, body, place: place >= 0 ? place : known.place };
      if (element >= 0) best.element = element;
      if (line >= 0) best = { ...best, line, end: endOf(view!.field.body, line, node) };
      least = hit.distance;
    }
  });
  return best;
}

function nearestCorner(hit: THREE.Intersection, mesh: THREE.Mesh): number {
  const position = mesh.geometry.getAttribute('position');
  const local = mesh.worldToLocal(hit.point.clone());
  const corner = new THREE.Vector3();
  let [nearest, least] = [hit.face!.a, Infinity];
  for (const vertex of [hit.face!.a, hit.face!.b, hit.face!.c]) {
    const distance = corner.fromBufferAttribute(position, vertex).distanceToSquared(local);
    if (distance < least) [nearest, least] = [vertex, distance];
  }
  return nearest;
}

/** Where the values of an item at a picked point come from, and at which index; null for nowhere. */
export function sourceAt(
  field: BodyField,
  item: string,
  perElement: boolean,
  pick: FieldPoint,
): { source: FieldSource; index: number } | null {
  for (const lines of [pick.element < 0, pick.element >= 0]) {
    const source = field.source(item, lines, perElement);
    const index = source ? indexAt(source, pick) : -1;
    if (source && index >= 0) return { source, index };
  }
  return null;
}

/** The item's value at a picked point in every frame; NaN where there is none. */
export function historyAt(run: Run, pick: Pick, item: string, perElement: boolean): Float32Array {
  const field = new BodyField(run.bodies[pick.body]!);
  const found = sourceAt(field, item, perElement, pick);
  if (!found) return new Float32Array(run.times.length).fill(NaN);
  return history(found.source, found.index, run.times.length);
}

export function pickName(body: Body, pick: Pick): string {
  return `${body.name} ${nodeNumber(body, pick.node)}`;
}

/** Whether a body has nodes to pick. */
export function isPickable(body: Body): boolean {
  return numNodes(body) > 0 && (body.faces !== null || body.elements.length > 0);
}
