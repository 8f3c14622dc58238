import * as THREE from 'three';
import { ball, massCentre, quarteredDisc, rod, solid, span, triad } from './glyphs';
import { BodyField } from './body_field';
import { FieldMaterial, type FieldShading } from './field_material';
import { spinOf, type Spin } from './spin';
import { SurfaceMesh } from './surface_mesh';
import { TubeMesh } from './tube_mesh';
import { nodeAt, numNodes, type Body } from './run';
import type { FramePlace } from './interpolation';
import type { BodyMotion } from './motion';
import type { Skin, SkinLook } from './skin';
import type { Theme } from './theme';
import type { ViewOptions } from './view_options';

/** Sizes of things that have none in the model [m]. */
export interface GlyphSize {
  /** Radius of a joint; everything else is a multiple of it. */
  joint: number;
  /** Least radius of a drawn beam: about one pixel when the whole run is in view. */
  leastRadius: number;
}

/** Whether a body consists of lines on which a mark would hardly be seen. */
function isThin({ faces, radius }: Body, size: GlyphSize): boolean {
  return !faces && radius.every((ends) => Math.max(...ends) < 0.7 * size.joint);
}

/** One body in the scene: bars and mass centre when rigid, else tubes and the surface of solids. */
export class BodyView {
  readonly root = new THREE.Group();
  readonly skins: Skin[] = [];
  readonly field: BodyField;
  private readonly frame = triad();
  private ghost: THREE.Group | null = null;

  constructor(
    private readonly motion: BodyMotion,
    color: string,
    private readonly theme: Theme,
    size: GlyphSize,
    shading: FieldShading,
    /** Shapes of contact or a pulley are drawn where it is. */
    private readonly hasShape = false,
  ) {
    const { body } = motion;
    this.field = new BodyField(body);
    const material = () => new FieldMaterial(color, shading);
    const spin = spinOf(body);
    if (body.elements.length > 0) this.add(new TubeMesh(motion, material(), size.leastRadius, spin));
    if (body.faces) {
      const edges = { onFaces: theme.edge, alone: theme.text };
      this.add(new SurfaceMesh(motion, material(), edges, spin));
    }
    if (this.skins.length === 0) this.addBars(color, size, spin);
    else if (spin && isThin(body, size)) this.root.add(this.disc(color, size, spin));
    this.frame.scale.setScalar(6 * size.joint);
    this.root.add(this.frame);
  }

  private add(skin: Skin): void {
    this.skins.push(skin);
    this.root.add(skin.root);
  }

  private makeGhost(): THREE.Group {
    const pale = new THREE.MeshBasicMaterial({
      color: this.theme.ghost,
      transparent: true,
      opacity: 0.35,
      depthWrite: false,
    });
    const ghost = new THREE.Group();
    if (!this.motion.body.displacement) return ghost;
    for (const skin of this.skins) {
      const mesh = skin.ghost(pale);
      mesh.frustumCulled = false;
      ghost.add(mesh);
    }
    return ghost;
  }

  private addBars(color: string, size: GlyphSize, spin: Spin | null): void {
    const { body } = this.motion;
    const material = solid(color);
    const origin = new THREE.Vector3();
    const nodes = [...Array(numNodes(body)).keys()].map((node) => nodeAt(body, node));
    const ends = [...body.markers.map((marker) => marker.position), ...nodes]
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
      if (spin) this.root.add(this.disc(color, size, spin));
      return;
    }
    if (this.hasShape) return;
    // Unequal edges show how the body is turned.
    const box = new THREE.Mesh(new THREE.BoxGeometry(4.6, 3.4, 2.4), material);
    box.scale.setScalar(size.joint);
    this.root.add(box);
  }

  /** Bars along the axis about which a body spins do not show the spin. */
  private disc(color: string, size: GlyphSize, { axis }: Spin): THREE.Object3D {
    const disc = quarteredDisc(color);
    disc.scale.setScalar(3 * size.joint);
    disc.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...axis));
    return disc;
  }

  /** Moves to the current pose and shape. */
  update(options: ViewOptions, look: SkinLook): void {
    const { pose } = this.motion;
    this.root.position.set(pose[0]!, pose[1]!, pose[2]!);
    this.root.quaternion.set(pose[4]!, pose[5]!, pose[6]!, pose[3]!);
    this.frame.visible = options.frames;
    if (options.undeformed && !this.ghost) this.root.add((this.ghost = this.makeGhost()));
    if (this.ghost) this.ghost.visible = options.undeformed;
    for (const skin of this.skins) {
      skin.deform(this.motion.displacement, options.scale);
      skin.look(look);
    }
  }

  /** Computes and paints the field; returns the range of its values, [NaN, NaN] if there is none. */
  paint(place: FramePlace, options: ViewOptions): [number, number] {
    const { perElement, item } = options.field;
    let [low, high] = [Infinity, -Infinity];
    for (const skin of this.skins) {
      const lines = skin instanceof TubeMesh;
      const painted = options.colors ? this.field.at(item, lines, perElement, place) : null;
      skin.paint(painted, perElement);
      if (!painted) continue;
      const { values } = painted;
      for (let i = 0; i < values.length; i++) {
        const value = values[i]!;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    return low <= high ? [low, high] : [NaN, NaN];
  }

  dispose(): void {
    for (const skin of this.skins) skin.dispose();
  }
}
