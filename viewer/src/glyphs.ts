import * as THREE from 'three';

/** Small solids of unit size that represent frames, loads and mass centres. */

export const kAxisColors = [0xd8403a, 0x3f9d45, 0x3b74d8] as const;

export function solid(color: THREE.ColorRepresentation): THREE.MeshLambertMaterial {
  return new THREE.MeshLambertMaterial({ color });
}

/** A cylinder of radius 1 from 0 to 1 along z, to be stretched between two points by `span`. */
const kRod = new THREE.CylinderGeometry(1, 1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);
export const kCone = new THREE.ConeGeometry(1, 1, 20).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const kBall = new THREE.SphereGeometry(1, 24, 16);
export const kZ = new THREE.Vector3(0, 0, 1);

export function rod(material: THREE.Material): THREE.Mesh {
  return new THREE.Mesh(kRod, material);
}

export function ball(material: THREE.Material): THREE.Mesh {
  return new THREE.Mesh(kBall, material);
}

/** Stretches an object of unit length along z from a to b. */
export function span(
  object: THREE.Object3D,
  a: THREE.Vector3,
  b: THREE.Vector3,
  radius: number,
): void {
  const along = new THREE.Vector3().subVectors(b, a);
  const length = along.length();
  object.position.copy(a);
  object.scale.set(radius, radius, Math.max(length, 1e-12));
  if (length > 0) object.quaternion.setFromUnitVectors(kZ, along.divideScalar(length));
}

/** Arrow of unit length along z. */
export function arrow(color: THREE.ColorRepresentation, thickness = 0.03): THREE.Group {
  const material = solid(color);
  const shaft = rod(material);
  shaft.scale.set(thickness, thickness, 0.75);
  const head = new THREE.Mesh(kCone, material);
  head.scale.set(3 * thickness, 3 * thickness, 0.27);
  head.position.z = 0.73;
  return new THREE.Group().add(shaft, head);
}

/** Arrow of unit length along z with a ring that turns about it. */
export function turnArrow(color: THREE.ColorRepresentation): THREE.Group {
  const material = solid(color);
  const ring = new THREE.Mesh(new THREE.TorusGeometry(0.3, 0.035, 8, 36, 1.6 * Math.PI), material);
  ring.position.z = 0.4;
  const head = new THREE.Mesh(kCone, material);
  head.scale.set(0.1, 0.1, 0.2);
  const end = 1.6 * Math.PI;
  head.position.set(0.3 * Math.cos(end), 0.3 * Math.sin(end), 0.4);
  head.quaternion.setFromUnitVectors(kZ, new THREE.Vector3(-Math.sin(end), Math.cos(end), 0));
  return arrow(color, 0.035).add(ring, head);
}

/** Three arrows x red, y green, z blue. */
export function triad(thickness = 0.035): THREE.Group {
  const group = new THREE.Group();
  kAxisColors.forEach((color, i) => {
    const axis = arrow(color, thickness);
    const to = new THREE.Vector3().setComponent(i, 1);
    axis.quaternion.setFromUnitVectors(kZ, to);
    group.add(axis);
  });
  return group;
}

/** The draughtsman's mark of a mass centre: a ball in eight fields, light and dark by turns. */
export function massCentre(color: THREE.ColorRepresentation): THREE.Mesh {
  const geometry = new THREE.SphereGeometry(1, 32, 24).toNonIndexed();
  const position = geometry.getAttribute('position');
  const colors = new Float32Array(3 * position.count);
  const fields = [new THREE.Color(color), new THREE.Color(0xffffff)];
  for (let i = 0; i < position.count; i += 3) {
    let sign = 1;
    for (let k = 0; k < 3; k++) {
      const sum = position.array[3 * i + k]! + position.array[3 * i + 3 + k]!;
      sign *= sum + position.array[3 * i + 6 + k]! >= 0 ? 1 : -1;
    }
    const field = fields[sign > 0 ? 0 : 1]!;
    for (let v = i; v < i + 3; v++) field.toArray(colors, 3 * v);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  const material = new THREE.MeshLambertMaterial({ vertexColors: true });
  return new THREE.Mesh(geometry, material);
}

/** A flat disc of radius 1 about z in four fields, light and dark by turns. */
export function quarteredDisc(color: THREE.ColorRepresentation): THREE.Group {
  const disc = new THREE.Group();
  const fields = [new THREE.Color(color), new THREE.Color(color).lerp(new THREE.Color(0xffffff), 0.7)];
  for (let quarter = 0; quarter < 4; quarter++) {
    const start = (quarter * Math.PI) / 2;
    const sector = new THREE.CylinderGeometry(1, 1, 0.16, 12, 1, false, start, Math.PI / 2);
    disc.add(new THREE.Mesh(sector.rotateX(Math.PI / 2), solid(fields[quarter % 2]!)));
  }
  return disc;
}

/** A bearing block: pyramid with its apex at the origin, standing on a plate below, up = +z. */
export function support(color: THREE.ColorRepresentation): THREE.Object3D {
  const material = solid(color);
  const pyramid = new THREE.ConeGeometry(1.9, 2.4, 4)
    .rotateY(Math.PI / 4)
    .rotateX(Math.PI / 2)
    .translate(0, 0, -1.2);
  const plate = new THREE.BoxGeometry(3.8, 3.8, 0.35).translate(0, 0, -2.5);
  return new THREE.Group().add(new THREE.Mesh(pyramid, material), new THREE.Mesh(plate, material));
}

/** Helix of ten turns of radius 1 and unit length along z: a spring to be stretched. */
export function spring(color: THREE.ColorRepresentation): THREE.Object3D {
  const straight = 0.08;
  const points = [...Array(401)].map((_, i) => {
    const u = i / 400;
    const wound = (u - straight) / (1 - 2 * straight);
    const radius = wound < 0 || wound > 1 ? 0 : 1;
    const angle = 20 * Math.PI * wound;
    return new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), u);
  });
  const geometry = new THREE.BufferGeometry().setFromPoints(points);
  return new THREE.Line(geometry, new THREE.LineBasicMaterial({ color }));
}
