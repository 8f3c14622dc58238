import * as THREE from 'three';
import { ball } from './glyphs';
import { LineEnds } from './line_ends';
import { quarters, type Spin } from './spin';
import { Tube } from './tube';
import { nodeAt, numNodes } from './run';
import { kNoValue, type Painted } from './surface_values';
import type { FieldMaterial } from './field_material';
import type { BodyMotion } from './motion';
import type { PickedVertex, Skin, SkinLook } from './skin';

/** The triangles of a Tube and the balls at its kinks. */
export class TubeMesh implements Skin {
  readonly root = new THREE.Group();
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, FieldMaterial>;
  private readonly tube: Tube;
  private readonly geometry = new THREE.BufferGeometry();
  private readonly values: Float32Array;
  private readonly balls: THREE.Mesh[];
  private readonly ends: LineEnds;
  private readonly plain: THREE.MeshLambertMaterial;
  private deformed = false;

  constructor(
    private readonly motion: BodyMotion,
    private readonly material: FieldMaterial,
    private readonly leastRadius: number,
    spin: Spin | null,
  ) {
    const { body } = motion;
    this.tube = new Tube(body, leastRadius);
    this.ends = new LineEnds(body.elements);
    const { positions, normals, indices } = this.tube;
    this.values = new Float32Array(positions.length / 3);
    const parts: [string, Float32Array, number][] = [
      ['position', positions, 3],
      ['normal', normals, 3],
      ['fieldValue', this.values, 1],
    ];
    for (const [name, values, size] of parts) {
      const attribute = new THREE.BufferAttribute(values, size);
      this.geometry.setAttribute(name, attribute.setUsage(THREE.DynamicDrawUsage));
    }
    if (spin) {
      this.tube.deform(new Float32Array(body.perNode * numNodes(body)), 0);
      this.geometry.setAttribute('spinQuarter', new THREE.BufferAttribute(quarters(spin, positions), 2));
      material.showSpin();
    }
    this.geometry.setIndex(indices);
    this.geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.root.add(this.mesh);
    this.plain = new THREE.MeshLambertMaterial({ color: material.color });
    const radii = new Float64Array(numNodes(body));
    body.elements.forEach(([a, b], e) => {
      [a, b].forEach((n, end) => (radii[n] = Math.max(radii[n]!, this.tube.inside[e]![end]!)));
    });
    this.balls = this.tube.kinks.map((node) => {
      const joint = ball(this.plain);
      joint.scale.setScalar(radii[node]!);
      this.root.add(joint);
      return joint;
    });
  }

  deform(displacement: Float32Array, scale: number): void {
    const { body } = this.motion;
    if (!body.displacement && this.deformed) return;
    this.deformed = true;
    this.tube.deform(displacement, scale);
    this.geometry.getAttribute('position').needsUpdate = true;
    this.geometry.getAttribute('normal').needsUpdate = true;
    this.tube.kinks.forEach((node, i) => {
      const d = nodeAt(body, node).map((x, k) => x + scale * displacement[body.perNode * node + k]!);
      this.balls[i]!.position.set(d[0]!, d[1]!, d[2]!);
    });
  }

  paint(painted: Painted | null, byFace: boolean): void {
    this.material.setField(painted !== null, false);
    if (!painted) return;
    const { elementOf, alongOf } = this.tube;
    const { elements } = this.motion.body;
    const whole = painted.on === 'lines' && byFace;
    const smooth = painted.on === 'lines' && !byFace;
    const on = smooth ? 'lineEnds' : painted.on;
    const values = smooth ? this.ends.fill(painted.values) : painted.values;
    for (let v = 0; v < elementOf.length; v++) {
      const e = elementOf[v]!;
      let value = values[e]!;
      if (!whole) {
        const [a, b] = on === 'nodes' ? elements[e]! : [2 * e, 2 * e + 1];
        const s = byFace ? 0.5 : alongOf[v]!;
        value = (1 - s) * values[a]! + s * values[b]!;
      }
      this.values[v] = Number.isNaN(value) ? kNoValue : value;
    }
    this.geometry.getAttribute('fieldValue').needsUpdate = true;
  }

  look({ planes, seeThrough }: SkinLook): void {
    for (const material of [this.material, this.plain]) material.clippingPlanes = planes;
    this.material.setBack(planes !== null || seeThrough, true);
  }

  vertex(index: number): PickedVertex {
    const line = this.tube.elementOf[index]!;
    const node = this.motion.body.elements[line]![this.tube.alongOf[index]! < 0.5 ? 0 : 1];
    return { node, place: -1, element: -1, line };
  }

  ghost(material: THREE.Material): THREE.Mesh {
    const { body } = this.motion;
    const tube = new Tube(body, this.leastRadius);
    tube.deform(new Float32Array(body.perNode * numNodes(body)), 0);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(tube.positions, 3));
    geometry.setIndex(tube.indices);
    return new THREE.Mesh(geometry, material);
  }

  dispose(): void {
    this.geometry.dispose();
  }
}
