import * as THREE from 'three';
import type { Triple } from './page_data';

/** Corners of the section of a wire. */
const kAround = 8;

function pointsOf(points: Float32Array): THREE.Vector3[] {
  const out: THREE.Vector3[] = [];
  for (let i = 0; i < points.length; i += 3) out.push(new THREE.Vector3(points[i], points[i + 1], points[i + 2]));
  return out;
}

/** Whether the last point is the first one again. */
function isClosed(points: THREE.Vector3[], reach: number): boolean {
  return points.length > 3 && points[0]!.distanceTo(points.at(-1)!) < 1e-4 * reach;
}

/** A wire along the points. @param reach of the curve [m] */
export function wireOf(points: Float32Array, reach: number, radius: number): THREE.BufferGeometry {
  const all = pointsOf(points);
  const closed = isClosed(all, reach);
  if (closed) all.pop();
  const curve = new THREE.CatmullRomCurve3(all, closed);
  return new THREE.TubeGeometry(curve, 2 * all.length, radius, kAround, closed);
}

/** A plate with the points as its rim, as thick on both sides of its plane. @param axis unit vector across it */
export function plateOf(points: Float32Array, axis: Triple, thickness: number): THREE.BufferGeometry {
  const normal = new THREE.Vector3(...axis);
  const aside = Math.abs(normal.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
  const u = new THREE.Vector3().crossVectors(aside, normal).normalize();
  const v = new THREE.Vector3().crossVectors(normal, u);
  const all = pointsOf(points);
  const outline = new THREE.Shape(all.map((p) => new THREE.Vector2(p.dot(u), p.dot(v))));
  const plate = new THREE.ExtrudeGeometry(outline, { depth: thickness, bevelEnabled: false });
  const height = all[0]!.dot(normal) - 0.5 * thickness;
  return plate.translate(0, 0, height).applyMatrix4(new THREE.Matrix4().makeBasis(u, v, normal));
}
