import * as THREE from 'three';
import { ElementFaces } from './element_faces';
import { quarters, type Spin } from './spin';
import { surfaceOf, type Surface } from './surface';
import { faceValue, kNoValue, VertexValues, type Painted } from './surface_values';
import type { FieldMaterial } from './field_material';
import type { PickedVertex, Skin, SkinLook } from './skin';
import type { BodyMotion } from './motion';

/** Meshes with more faces start without element edges, which would merge into a grey haze. */
export const kManyFaces = 15000;

function attribute(values: Float32Array, size: number): THREE.BufferAttribute {
  return new THREE.BufferAttribute(values, size).setUsage(THREE.DynamicDrawUsage);
}

/** Data of a surface for the graphics card. */
interface Picture {
  geometry: THREE.BufferGeometry;
  values: Float32Array;
}

function picture(positions: Float32Array, normals: Float32Array, indices: Uint32Array): Picture {
  const geometry = new THREE.BufferGeometry();
  const values = new Float32Array(positions.length / 3);
  geometry.setAttribute('position', attribute(positions, 3));
  geometry.setAttribute('normal', attribute(normals, 3));
  geometry.setAttribute('fieldValue', attribute(values, 1));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  // The vertices move: the sphere is never computed, the object never culled.
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
  return { geometry, values };
}

/** The surface of a body of solids or shells in the scene, with the edges of its elements. */
export class SurfaceMesh implements Skin {
  readonly root = new THREE.Group();
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, FieldMaterial>;
  private readonly surface: Surface;
  private readonly smooth: Picture;
  private readonly vertexValues: VertexValues;
  private readonly lines: THREE.LineSegments;
  private readonly thin: THREE.LineBasicMaterial;
  /** One colour per face; created when first needed. */
  private split: { faces: ElementFaces; picture: Picture } | null = null;
  private byFace = false;
  private deformed = false;

  constructor(
    private readonly motion: BodyMotion,
    private readonly material: FieldMaterial,
    private readonly edgeColors: { onFaces: string; alone: string },
    private readonly spin: Spin | null,
  ) {
    this.surface = surfaceOf(motion.body);
    const { positions, normals, indices } = this.surface;
    this.smooth = picture(positions, normals, indices);
    this.mark(this.smooth, this.surface.restPositions());
    this.vertexValues = new VertexValues(this.surface, motion.body.faces!);
    // Edges are drawn in front of the faces they bound.
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 1;
    this.mesh = new THREE.Mesh(this.smooth.geometry, material);
    this.thin = new THREE.LineBasicMaterial({ transparent: true });
    const net = new THREE.BufferGeometry();
    net.setAttribute('position', this.smooth.geometry.getAttribute('position'));
    this.lines = new THREE.LineSegments(net, this.thin);
    for (const part of [this.mesh, this.lines]) {
      part.frustumCulled = false;
      this.root.add(part);
    }
  }

  private mark({ geometry }: Picture, rest: Float32Array): void {
    if (!this.spin) return;
    geometry.setAttribute('spinQuarter', new THREE.BufferAttribute(quarters(this.spin, rest), 2));
    this.material.showSpin();
  }

  deform(displacement: Float32Array, scale: number): void {
    if (!this.motion.body.displacement && this.deformed) return;
    this.deformed = true;
    this.surface.deform(displacement, scale);
    this.changed(this.smooth, 'position', 'normal');
    if (!this.byFace || !this.split) return;
    this.split.faces.update();
    this.changed(this.split.picture, 'position', 'normal');
  }

  private changed({ geometry }: Picture, ...names: string[]): void {
    for (const name of names) geometry.getAttribute(name).needsUpdate = true;
  }

  paint(painted: Painted | null, byFace: boolean): void {
    this.material.setField(painted !== null, byFace);
    this.use(painted !== null && byFace);
    if (!painted) return;
    if (!this.byFace) {
      this.vertexValues.fill(painted, this.smooth.values);
      this.changed(this.smooth, 'fieldValue');
      return;
    }
    const { faces, picture: own } = this.split!;
    faces.carrier.forEach((vertex, face) => {
      const value = faceValue(this.surface, this.motion.body.faces!, painted, face);
      own.values[vertex] = Number.isNaN(value) ? kNoValue : value;
    });
    this.changed(own, 'fieldValue');
  }

  /** Switches between one value per vertex and one per face. */
  private use(byFace: boolean): void {
    if (byFace === this.byFace) return;
    this.byFace = byFace;
    if (byFace && !this.split) {
      const faces = new ElementFaces(this.surface);
      this.split = { faces, picture: picture(faces.positions, faces.normals, faces.indices) };
      const rest = this.surface.restPositions();
      const all = new Float32Array(3 * faces.vertexOf.length);
      faces.vertexOf.forEach((v, i) => all.set(rest.subarray(3 * v, 3 * v + 3), 3 * i));
      this.mark(this.split.picture, all);
    }
    if (byFace) {
      this.split!.faces.update();
      this.changed(this.split!.picture, 'position', 'normal');
    }
    this.mesh.geometry = byFace ? this.split!.picture.geometry : this.smooth.geometry;
  }

  look({ edges, planes, seeThrough }: SkinLook): void {
    const { surface } = this;
    const many = surface.corners.length / 4 > kManyFaces;
    const wanted = edges === 'auto' ? (many ? 'outline' : 'mesh') : edges;
    this.mesh.visible = wanted !== 'wireframe';
    this.lines.visible = wanted !== 'none';
    const list = wanted === 'outline' ? surface.outline : surface.edges;
    if (this.lines.geometry.getIndex()?.array !== list) {
      this.lines.geometry.setIndex(new THREE.BufferAttribute(list, 1));
    }
    this.thin.opacity = { none: 0, outline: 0.6, mesh: 0.32, wireframe: 0.5 }[wanted];
    this.thin.color.set(this.edgeColors[wanted === 'wireframe' ? 'alone' : 'onFaces']);
    for (const material of [this.material, this.thin]) material.clippingPlanes = planes;
    const back = surface.isOpen || planes !== null || seeThrough;
    this.material.setBack(back, !surface.isOpen);
  }

  vertex(index: number, triangle: number): PickedVertex {
    const { surface } = this;
    const vertex = this.split && this.byFace ? this.split.faces.vertexOf[index]! : index;
    const element = this.motion.body.faces!.elements[surface.faceOf(triangle)]!;
    return { node: surface.nodeOf[vertex]!, place: surface.placeOf[vertex]!, element, line: -1 };
  }

  ghost(material: THREE.Material): THREE.Mesh {
    const geometry = new THREE.BufferGeometry();
    const rest = new THREE.BufferAttribute(this.surface.restPositions(), 3);
    geometry.setAttribute('position', rest);
    geometry.setIndex(this.smooth.geometry.getIndex());
    return new THREE.Mesh(geometry, material);
  }

  dispose(): void {
    this.smooth.geometry.dispose();
    this.split?.picture.geometry.dispose();
    this.lines.geometry.dispose();
  }
}
