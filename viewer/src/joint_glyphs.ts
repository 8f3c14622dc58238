import * as THREE from 'three';
import { arrow, ball, kCone, kZ, solid } from './glyphs';

/** Small solids of unit size that represent joints. */

function revolute(material: THREE.Material): THREE.Object3D {
  const body = new THREE.CylinderGeometry(0.8, 0.8, 1.6, 28).rotateX(Math.PI / 2);
  const pin = new THREE.CylinderGeometry(0.3, 0.3, 2.3, 18).rotateX(Math.PI / 2);
  const dark = solid(0x20262e);
  return new THREE.Group().add(new THREE.Mesh(body, material), new THREE.Mesh(pin, dark));
}

function fixed(material: THREE.Material): THREE.Object3D {
  return new THREE.Mesh(new THREE.BoxGeometry(1.5, 1.5, 1.5), material);
}

function bushing(material: THREE.Material): THREE.Object3D {
  const rings = new THREE.Group();
  for (const z of [-0.6, 0, 0.6]) {
    const ring = new THREE.Mesh(new THREE.TorusGeometry(0.8, 0.25, 10, 28), material);
    ring.position.z = z;
    rings.add(ring);
  }
  return rings;
}

/** Three quarters of a circle with an arrow head: a driven rotation. */
function drivenRotation(): THREE.Object3D {
  const material = solid(0xd8403a);
  const ring = new THREE.Mesh(new THREE.TorusGeometry(1.9, 0.14, 10, 48, 1.5 * Math.PI), material);
  const head = new THREE.Mesh(kCone, material);
  head.scale.set(0.45, 0.45, 0.9);
  head.position.set(0, -1.9, 0);
  head.quaternion.setFromUnitVectors(kZ, new THREE.Vector3(1, 0, 0));
  const turned = new THREE.Group().add(ring, head);
  // The gap of the circle points to the place of a support.
  turned.rotation.z = -Math.PI / 4;
  return new THREE.Group().add(turned);
}

function drivenTranslation(): THREE.Object3D {
  const pointer = arrow(0xd8403a, 0.05);
  pointer.scale.setScalar(4);
  return pointer;
}

/** Any coordinate: an arrow through the arrow around it. */
function drivenCoordinate(): THREE.Object3D {
  const around = drivenRotation();
  around.scale.setScalar(0.6);
  return new THREE.Group().add(around, drivenTranslation());
}

const kDark = 0x20262e;

/** A pin in a bush longer than it: turns and slides. */
function cylindrical(material: THREE.Material): THREE.Object3D {
  const bush = new THREE.CylinderGeometry(0.8, 0.8, 1.8, 28).rotateX(Math.PI / 2);
  const pin = new THREE.CylinderGeometry(0.35, 0.35, 4.4, 18).rotateX(Math.PI / 2);
  return new THREE.Group().add(new THREE.Mesh(bush, material), new THREE.Mesh(pin, solid(kDark)));
}

/** The pin has a thread: rings along it. */
function screw(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group().add(cylindrical(material));
  for (const z of [-1.9, -1.6, -1.3, 1.3, 1.6, 1.9]) {
    const ring = new THREE.Mesh(new THREE.TorusGeometry(0.42, 0.09, 8, 24), solid(kDark));
    ring.position.z = z;
    ring.rotation.x = 0.2;
    group.add(ring);
  }
  return group;
}

/** Two plates face to face. */
function planar(material: THREE.Material): THREE.Object3D {
  const lower = new THREE.Mesh(new THREE.BoxGeometry(4, 4, 0.3), material);
  const upper = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 0.3), solid(kDark));
  upper.position.z = 0.32;
  return new THREE.Group().add(lower, upper);
}

/** A cross of two arms, one of them along z, between two forks. */
function universal(material: THREE.Material): THREE.Object3D {
  const along = new THREE.CylinderGeometry(0.25, 0.25, 2.6, 16).rotateX(Math.PI / 2);
  const across = new THREE.CylinderGeometry(0.25, 0.25, 2.6, 16);
  const fork = new THREE.TorusGeometry(1.2, 0.22, 10, 28, Math.PI);
  const first = new THREE.Mesh(fork, material);
  first.rotation.set(0, Math.PI / 2, 0);
  first.rotation.order = 'YXZ';
  const second = new THREE.Mesh(fork, material);
  second.rotation.z = Math.PI / 2;
  const dark = solid(kDark);
  return new THREE.Group().add(
    new THREE.Mesh(along, dark),
    new THREE.Mesh(across, dark),
    first,
    second,
  );
}

/** A ball in a cage of rings: shafts that turn at the same speed. */
function constantVelocity(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group().add(ball(material));
  for (let k = 0; k < 3; k++) {
    const ring = new THREE.Mesh(new THREE.TorusGeometry(1.25, 0.1, 8, 32), solid(kDark));
    ring.rotation.set(Math.PI / 2, (k * Math.PI) / 3, 0);
    group.add(ring);
  }
  return group;
}

/** A ball on a rod along z. */
function pointOnLine(material: THREE.Material): THREE.Object3D {
  const line = new THREE.CylinderGeometry(0.2, 0.2, 5, 14).rotateX(Math.PI / 2);
  return new THREE.Group().add(ball(material), new THREE.Mesh(line, solid(kDark)));
}

/** A ball on a plate across z. */
function pointInPlane(material: THREE.Material): THREE.Object3D {
  const plate = new THREE.Mesh(new THREE.BoxGeometry(4, 4, 0.2), solid(kDark));
  return new THREE.Group().add(ball(material), plate);
}

/** Two rods side by side along z. */
function parallel(material: THREE.Material): THREE.Object3D {
  const rods = new THREE.Group();
  for (const x of [-0.5, 0.5]) {
    const one = new THREE.CylinderGeometry(0.25, 0.25, 3, 14).rotateX(Math.PI / 2);
    rods.add(new THREE.Mesh(one.translate(x, 0, 0), material));
  }
  return rods;
}

/** The end of a rod; the line to its other end is drawn where they are apart. */
function pinEnd(material: THREE.Material): THREE.Object3D {
  const end = ball(material);
  end.scale.setScalar(0.7);
  return new THREE.Group().add(end);
}

/** Three rods at right angles: directions are held, places are not. */
function orientation(material: THREE.Material): THREE.Object3D {
  const rods = new THREE.Group();
  for (const turn of [[0, 0], [Math.PI / 2, 0], [0, Math.PI / 2]] as const) {
    const one = new THREE.CylinderGeometry(0.22, 0.22, 2.4, 14).rotateX(turn[0]).rotateZ(turn[1]);
    rods.add(new THREE.Mesh(one, material));
  }
  return rods;
}

/** A toothed wheel about z. */
function gear(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group();
  const wheel = new THREE.CylinderGeometry(1.3, 1.3, 0.7, 32).rotateX(Math.PI / 2);
  group.add(new THREE.Mesh(wheel, material));
  for (let k = 0; k < 12; k++) {
    const tooth = new THREE.Mesh(new THREE.BoxGeometry(0.5, 0.3, 0.7), material);
    const angle = (k * Math.PI) / 6;
    tooth.position.set(1.5 * Math.cos(angle), 1.5 * Math.sin(angle), 0);
    tooth.rotation.z = angle;
    group.add(tooth);
  }
  const hole = new THREE.CylinderGeometry(0.35, 0.35, 0.8, 18).rotateX(Math.PI / 2);
  return group.add(new THREE.Mesh(hole, solid(kDark)));
}

/** A small wheel on a bar with teeth; the wheel's axis along z. */
function rack(material: THREE.Material): THREE.Object3D {
  const wheel = gear(material);
  const bar = new THREE.Mesh(new THREE.BoxGeometry(5, 0.5, 0.7), solid(kDark));
  bar.position.y = -2;
  return new THREE.Group().add(wheel, bar);
}

/** Two pulleys about z with a belt around them. */
function belt(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group();
  for (const x of [-1.2, 1.2]) {
    const pulley = new THREE.CylinderGeometry(0.8, 0.8, 0.6, 28).rotateX(Math.PI / 2);
    group.add(new THREE.Mesh(pulley.translate(x, 0, 0), material));
  }
  for (const y of [-0.85, 0.85]) {
    const span = new THREE.Mesh(new THREE.BoxGeometry(2.4, 0.12, 0.6), solid(kDark));
    span.position.y = y;
    group.add(span);
  }
  return group;
}

/** Two links of a chain: coordinates that hang on each other. */
function coupler(material: THREE.Material): THREE.Object3D {
  const first = new THREE.Mesh(new THREE.TorusGeometry(0.9, 0.22, 10, 28), material);
  const second = new THREE.Mesh(new THREE.TorusGeometry(0.9, 0.22, 10, 28), solid(kDark));
  second.position.x = 1.1;
  second.rotation.x = Math.PI / 2;
  return new THREE.Group().add(first, second);
}

/** A carriage with two wheels on a rail along z. */
function sliderOnBeam(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group();
  const rail = new THREE.CylinderGeometry(0.18, 0.18, 5, 14).rotateX(Math.PI / 2);
  const sleeve = new THREE.CylinderGeometry(0.6, 0.6, 1.2, 24, 1, true).rotateX(Math.PI / 2);
  group.add(new THREE.Mesh(rail, solid(kDark)), new THREE.Mesh(sleeve, material));
  for (const z of [-0.9, 0.9]) {
    const wheel = new THREE.Mesh(new THREE.TorusGeometry(0.5, 0.2, 10, 28), material);
    wheel.position.z = z;
    group.add(wheel);
  }
  return group;
}

/** A wheel on its edge over a plate. */
function rolling(material: THREE.Material): THREE.Object3D {
  const wheel = new THREE.Mesh(new THREE.TorusGeometry(1.2, 0.3, 12, 36), material);
  const axle = new THREE.CylinderGeometry(0.2, 0.2, 1.4, 14).rotateX(Math.PI / 2);
  const plate = new THREE.Mesh(new THREE.BoxGeometry(4, 0.15, 3), solid(kDark));
  plate.position.y = -1.6;
  return new THREE.Group().add(wheel, new THREE.Mesh(axle, solid(kDark)), plate);
}

/** A pin through a plate with a long hole, across z; the curve itself is drawn as a shape. */
function slot(material: THREE.Material): THREE.Object3D {
  const group = new THREE.Group();
  for (const y of [-0.75, 0.75]) {
    const edge = new THREE.Mesh(new THREE.BoxGeometry(4, 0.4, 0.4), solid(kDark));
    edge.position.y = y;
    group.add(edge);
  }
  const pin = new THREE.CylinderGeometry(0.5, 0.5, 1.8, 20).rotateX(Math.PI / 2);
  return group.add(new THREE.Mesh(pin, material));
}

/** Glyph of a joint by its type, its axis along z; unknown types get an octahedron. */
export function jointGlyph(type: string, color: THREE.ColorRepresentation): THREE.Object3D {
  const material = solid(color);
  switch (type.replaceAll('_', '-').toLowerCase()) {
    case 'revolute':
    case 'hinge':
      return revolute(material);
    case 'spherical':
      return new THREE.Group().add(ball(material));
    case 'prismatic':
      return new THREE.Mesh(new THREE.BoxGeometry(1.6, 1.6, 3.2), material);
    case 'fixed':
      return fixed(material);
    case 'bushing':
      return bushing(material);
    case 'cylindrical':
      return cylindrical(material);
    case 'screw':
      return screw(material);
    case 'planar':
      return planar(material);
    case 'universal':
      return universal(material);
    case 'constant-velocity':
      return constantVelocity(material);
    case 'point-on-line':
      return pointOnLine(material);
    case 'point-in-plane':
      return pointInPlane(material);
    case 'parallel':
      return parallel(material);
    case 'orientation':
      return orientation(material);
    case 'distance':
      return pinEnd(material);
    case 'gear':
      return gear(material);
    case 'rack':
      return rack(material);
    case 'belt':
      return belt(material);
    case 'slot':
      return slot(material);
    case 'coupler':
      return coupler(material);
    case 'slider-on-beam':
      return sliderOnBeam(material);
    case 'rolling':
      return rolling(material);
    case 'prescribed-rotation':
      return drivenRotation();
    case 'prescribed-translation':
      return drivenTranslation();
    case 'prescribed-coordinate':
      return drivenCoordinate();
    default:
      return new THREE.Mesh(new THREE.OctahedronGeometry(1.1), material);
  }
}
