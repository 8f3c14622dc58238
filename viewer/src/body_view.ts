import * as THREE from 'three';
import { ball, massCentre, rod, solid, span, triad } from './glyphs';
import { colorAt } from './color_map';
import { SurfaceMesh } from './surface_mesh';
import { Tube } from './tube';
import type { BodyMotion } from './motion';
import type { Theme } from './theme';
import type { ViewOptions } from './view_options';

/** Lengths of things that have none in the model [m]. */
export interface GlyphSize {
  /** Radius of a joint; everything else is a multiple of it. */
  joint: number;
  /** Least radius of a drawn beam: about one pixel when the whole run is in view. */
  leastRadius: number;
}

type SkinMaterial = THREE.MeshStandardMaterial | THREE.MeshBasicMaterial;

/** What a body consists of when it is drawn: tubes, or the surface of a solid. */
interface Skin {
  readonly root: THREE.Group;
  deform(displacement: Float32Array, scale: number): void;
  paint(stress: Float32Array | null, range: number): void;
}

/** One body in the scene: bars and mass centre when rigid, else tubes and the surface of solids. */
export class BodyView {
  readonly root = new THREE.Group();
  private readonly frame = triad();
  private readonly tubes: Skin | null = null;
  private readonly surface: Skin | null = null;
  private readonly ghost = new THREE.Group();

  constructor(
    private readonly motion: BodyMotion,
    color: string,
    theme: Theme,
    size: GlyphSize,
  ) {
    const { body } = motion;
    const material = solid(color);
    const tubesOf = (paint: SkinMaterial) => new TubeMesh(motion, size.leastRadius, paint);
    const surfaceOf = (paint: SkinMaterial) => new SurfaceMesh(motion, paint, theme.text);
    if (body.elements.length > 0) this.tubes = this.addSkin(tubesOf, material, theme);
    if (body.faces.length > 0) this.surface = this.addSkin(surfaceOf, solid(color), theme);
    if (!this.tubes && !this.surface) this.addBars(material, color, size);
    this.root.add(this.ghost);
    this.frame.scale.setScalar(6 * size.joint);
    this.root.add(this.frame);
  }

  /** Adds a skin, and its undeformed shape as a ghost. */
  private addSkin(
    make: (material: SkinMaterial) => Skin,
    material: THREE.MeshStandardMaterial,
    theme: Theme,
  ): Skin {
    const { body } = this.motion;
    const skin = make(material);
    this.root.add(skin.root);
    if (body.displacement) {
      const pale = new THREE.MeshBasicMaterial({
        color: theme.ghost,
        transparent: true,
        opacity: 0.35,
        depthWrite: false,
      });
      const ghost = make(pale);
      ghost.deform(new Float32Array(6 * body.nodes.length), 0);
      this.ghost.add(ghost.root);
    }
    return skin;
  }

  private addBars(material: THREE.Material, color: string, size: GlyphSize): void {
    const { body } = this.motion;
    const origin = new THREE.Vector3();
    const ends = [...body.markers.map((marker) => marker.position), ...body.nodes]
      .map((p) => new THREE.Vector3(...p))
      .filter((p) => p.length() > 0.5 * size.joint);
    for (const end of ends) {
      const bar = rod(material);
      span(bar, origin, end, 0.5 * size.joint);
      const tip = ball(material);
      tip.position.copy(end);
      tip.scale.setScalar(0.7 * size.joint);
      this.root.add(bar, tip);
    }
    if (ends.length > 0) {
      const centre = massCentre(color);
      centre.scale.setScalar(0.95 * size.joint);
      this.root.add(centre);
      return;
    }
    // Unequal edges show how the body is turned.
    const box = new THREE.Mesh(new THREE.BoxGeometry(4.6, 3.4, 2.4), material);
    box.scale.setScalar(size.joint);
    this.root.add(box);
  }

  update(options: ViewOptions, stressRange: number): void {
    const { pose } = this.motion;
    this.root.position.set(pose[0]!, pose[1]!, pose[2]!);
    this.root.quaternion.set(pose[4]!, pose[5]!, pose[6]!, pose[3]!);
    this.frame.visible = options.frames;
    this.ghost.visible = options.undeformed;
    const { body, displacement, stress, solidStress } = this.motion;
    const painted = (values: Float32Array, recorded: unknown) =>
      options.stress && recorded !== null ? values : null;
    this.tubes?.deform(displacement, options.scale);
    this.tubes?.paint(painted(stress, body.stress), stressRange);
    this.surface?.deform(displacement, options.scale);
    this.surface?.paint(painted(solidStress, body.solidStress), stressRange);
  }
}

/** The triangles of a Tube and the balls at its kinks. */
class TubeMesh {
  readonly root = new THREE.Group();
  private readonly tube: Tube;
  private readonly geometry = new THREE.BufferGeometry();
  private readonly colors: THREE.BufferAttribute;
  private readonly balls: THREE.Mesh[];
  private readonly plain: THREE.Color;
  private deformed = false;

  constructor(
    private readonly motion: BodyMotion,
    leastRadius: number,
    private readonly material: SkinMaterial,
  ) {
    this.tube = new Tube(motion.body, leastRadius);
    const { positions, normals, indices } = this.tube;
    this.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    this.geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    this.colors = new THREE.BufferAttribute(new Float32Array(positions.length).fill(1), 3);
    this.geometry.setAttribute('color', this.colors);
    for (const name of ['position', 'normal', 'color']) {
      const attribute = this.geometry.getAttribute(name) as THREE.BufferAttribute;
      attribute.setUsage(THREE.DynamicDrawUsage);
    }
    this.geometry.setIndex(indices);
    this.plain = material.color.clone();
    const mesh = new THREE.Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    this.root.add(mesh);
    const radii = motion.body.nodes.map(() => 0);
    motion.body.elements.forEach(([a, b], e) => {
      for (const n of [a, b]) radii[n] = Math.max(radii[n]!, this.tube.radius[e]!);
    });
    this.balls = this.tube.kinks.map((node) => {
      const joint = ball(solid(this.plain));
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
      const p = body.nodes[node]!;
      const d = [0, 1, 2].map((k) => p[k]! + scale * displacement[6 * node + k]!);
      this.balls[i]!.position.set(d[0]!, d[1]!, d[2]!);
    });
  }

  /** Colours every element by its stress, or all of it plainly for null. */
  paint(stress: Float32Array | null, range: number): void {
    const colored = stress !== null && range > 0;
    if (this.material.vertexColors !== colored) {
      this.material.vertexColors = colored;
      this.material.color.copy(colored ? new THREE.Color(0xffffff) : this.plain);
      this.material.needsUpdate = true;
    }
    if (!colored) return;
    const color = new THREE.Color();
    const { elementOf } = this.tube;
    let last = -1;
    for (let v = 0; v < elementOf.length; v++) {
      const e = elementOf[v]!;
      if (e !== last) color.setRGB(...colorAt(stress[e]! / range), THREE.SRGBColorSpace);
      last = e;
      color.toArray(this.colors.array, 3 * v);
    }
    this.colors.needsUpdate = true;
  }
}
