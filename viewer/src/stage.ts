import * as THREE from 'three';
import { BodyView, type GlyphSize } from './body_view';
import { CameraRig, kClosest, type Insets } from './camera_rig';
import { Crowd } from './crowd';
import { closestTo, crowdJoint, isCrowd } from './crowd_size';
import { CornerTriad } from './corner_triad';
import { Grid } from './grid';
import { ball } from './glyphs';
import { CableView } from './cable_view';
import { JointView } from './joint_view';
import { Labels, type Label } from './labels';
import { LoadView } from './load_view';
import { ShapeView } from './shape_view';
import { Motion } from './motion';
import { kMostNames, namesOf, spread } from './names';
import { orientationOf, type Orientation } from './orientation';
import { largestReactions, ReactionView } from './reaction_view';
import { pickAlong, pickName, type Pick } from './picks';
import { paintsSlowly } from './graphics';
import { Section } from './section';
import { Trace } from './trace';
import type { Bounds } from './bounds';
import type { FieldShading } from './field_material';
import type { Run } from './run';
import type { Theme } from './theme';
import type { Triple } from './page_data';
import type { ViewOptions } from './view_options';

/** Edge of the corner with the world axes [CSS px]. */
const kCorner = 92;

/** The 3-D view of a run, the model scaled to unit size so that every model has the same depth range. */
export class Stage {
  readonly canvas = document.createElement('canvas');
  readonly labels = new Labels();
  readonly rig: CameraRig;
  readonly motion: Motion;
  readonly section: Section;
  gridSpacing = 0;
  /** Range of the field shown at the current time; NaN without one. */
  present: [number, number] = [NaN, NaN];
  /** Time of the last picture: shapes and colours, and transfer to the graphics card [ms]. */
  cost = { update: 0, render: 0 };
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly model = new THREE.Group();
  private readonly orientation: Orientation;
  private readonly corner: CornerTriad;
  private readonly trace: Trace;
  private readonly glyphs: GlyphSize;
  private theme!: Theme;
  /** Null where a crowd draws the body. */
  private bodies: (BodyView | null)[] = [];
  private crowd: Crowd | null = null;
  private joints: JointView[] = [];
  private loads: LoadView[] = [];
  private shapes: ShapeView[] = [];
  private cables: CableView[] = [];
  private reactions: ReactionView[] = [];
  private dots: THREE.Mesh[] = [];
  private width = 1;
  private height = 1;

  /** Throws if the browser has no WebGL. `moved` is called whenever the camera moves. */
  constructor(
    private readonly run: Run,
    readonly bounds: Bounds,
    theme: Theme,
    private readonly shading: FieldShading,
    moved: () => void,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: !paintsSlowly() });
    this.renderer.localClippingEnabled = true;
    this.motion = new Motion(run);
    this.section = new Section(bounds, this.motion.bodies);
    this.orientation = orientationOf(run);
    const joint = 0.016 * Math.min(bounds.size, bounds.machine);
    this.glyphs = {
      joint: isCrowd(run) ? crowdJoint(run, joint) : joint,
      leastRadius: 0.0022 * bounds.size,
    };
    this.corner = new CornerTriad(run.gravity);
    this.trace = new Trace(run, bounds.center);
    const scale = 1 / bounds.size;
    this.model.scale.setScalar(scale);
    this.model.position.set(...bounds.center).multiplyScalar(-scale);
    this.scene.add(this.model, new THREE.HemisphereLight(0xffffff, 0xb4bcc6, 2.1));
    const closest = isCrowd(run) ? closestTo(this.glyphs.joint / bounds.size) : kClosest;
    this.rig = new CameraRig(this.canvas, this.orientation.up, run.planar !== null, moved, closest);
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    const headlight = new THREE.DirectionalLight(0xffffff, 1.7);
    headlight.name = 'headlight';
    this.scene.add(headlight, headlight.target);
    this.setTheme(theme);
  }

  /** Rebuilds everything drawn in the colours of `theme`. */
  setTheme(theme: Theme): void {
    this.theme = theme;
    this.scene.background = new THREE.Color(theme.background);
    for (const body of this.bodies) body?.dispose();
    this.crowd?.dispose();
    this.model.clear();
    const { run, glyphs, orientation, motion } = this;
    const grid = new Grid(this.bounds, orientation, run.planar !== null, theme);
    this.gridSpacing = grid.spacing;
    const shaped = new Set([
      ...run.shapes.map(({ on }) => on.body),
      ...run.cables.flatMap(({ sides, radii }) => sides.filter((_, k) => radii[k] !== 0).map(({ body }) => body)),
    ]);
    // A belt is drawn as it runs: no glyph beside it.
    const belts = new Set(run.cables.map(({ name }) => name));
    const joints = run.joints.filter(({ name }) => !belts.has(name));
    const largest = largestReactions(run);
    this.crowd = isCrowd(run)
      ? new Crowd(motion, joints, shaped, largest, theme, glyphs.joint)
      : null;
    const single = this.crowd?.rest ?? { bodies: new Set(run.bodies.keys()), joints, shapes: run.shapes };
    this.bodies = motion.bodies.map((body, i) => {
      if (!single.bodies.has(i)) return null;
      const color = theme.bodies[i % theme.bodies.length]!;
      return new BodyView(body, color, theme, glyphs, this.shading, shaped.has(i));
    });
    this.shapes = single.shapes.map((shape) => {
      const color = theme.bodies[Math.max(0, shape.on.body) % theme.bodies.length]!;
      return new ShapeView(shape, motion, theme, color, this.bounds.size);
    });
    this.cables = run.cables.map((cable) => new CableView(cable, motion, theme, glyphs));
    this.joints = single.joints.map(
      (joint) => new JointView(joint, motion, theme, glyphs, orientation.up),
    );
    this.loads = run.loads.map((load) => new LoadView(load, motion, glyphs));
    this.reactions = (this.crowd ? [] : run.joints)
      .filter(({ force, torque }) => force || torque)
      .map((joint) => new ReactionView(joint, motion, glyphs, largest));
    this.model.add(grid.root, this.trace.root);
    if (this.crowd) this.model.add(this.crowd.root);
    const views = [
      ...this.bodies.filter((body) => body !== null),
      ...this.shapes,
      ...this.cables,
      ...this.joints,
      ...this.loads,
      ...this.reactions,
    ];
    for (const view of views) this.model.add(view.root);
  }

  /** @param insets area covered by controls */
  resize(width: number, height: number, insets: Insets): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.renderer.setPixelRatio(paintsSlowly() ? 1 : Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(this.width, this.height, false);
    this.rig.resize(this.width, this.height, insets);
  }

  /** Looks at the whole run, from `back` or from where the camera is. */
  fit(back?: Triple): void {
    // Glyphs extend beyond the points they mark.
    const margin = 3.5 * this.glyphs.joint;
    const half = this.bounds.half.map((h) => (h + margin) / this.bounds.size) as Triple;
    this.rig.fit(half, back);
  }

  fitHome(): void {
    this.fit(this.orientation.back);
  }

  /** Updates shapes and colours to time t; `present` is known afterwards. */
  update(t: number, options: ViewOptions): void {
    const began = performance.now();
    this.motion.setTime(t);
    let [low, high] = [Infinity, -Infinity];
    this.bodies.forEach((body, i) => {
      if (!body) return;
      const planes = this.section.planes(options.section, i);
      const seeThrough = options.colors && options.field.cut === 'hide';
      body.update(options, { edges: options.edges, planes, seeThrough });
      const [a, b] = body.paint(this.motion.place, options);
      if (a < low) low = a;
      if (b > high) high = b;
    });
    this.present = low <= high ? [low, high] : [NaN, NaN];
    for (const [views, shown] of [
      [this.joints, options.joints],
      [this.shapes, options.joints],
      [this.cables, options.joints],
      [this.loads, options.loads],
      [this.reactions, options.reactions],
    ] as const) {
      for (const view of views) {
        view.root.visible = shown;
        if (shown) view.update(options.scale);
      }
    }
    if (this.crowd) {
      const target = this.model.worldToLocal(this.rig.target.clone()).toArray();
      this.crowd.update(options, this.pixelSize(target), this.rig.frustumOf(this.model));
    }
    this.cost.update = performance.now() - began;
  }

  /** Draws the state prepared by `update`. */
  render(options: ViewOptions, picks: { pick: Pick; color: string }[]): void {
    const began = performance.now();
    const { index, fraction } = this.motion.place;
    const traced = this.run.bodies.findIndex(({ name }) => name === options.trace?.body);
    const color = this.theme.bodies[Math.max(0, traced) % this.theme.bodies.length]!;
    this.trace.update(options.trace, options.scale, index + (fraction > 0.5 ? 1 : 0), color);
    this.trace.resize(this.width, this.height);
    this.showDots(picks, options.scale);
    this.aimHeadlight();
    this.renderer.render(this.scene, this.rig.camera);
    this.corner.render(this.renderer, this.rig.camera, kCorner);
    this.showLabels(options, picks);
    this.cost.render = performance.now() - began;
  }

  /** The motion has changed, for example to another mode. */
  forget(): void {
    this.trace.forget();
  }

  private aimHeadlight(): void {
    const light = this.scene.getObjectByName('headlight')!;
    light.position.set(-0.5, 0.8, 1).applyQuaternion(this.rig.camera.quaternion);
  }

  /** World position of a picked node [m]. */
  placeOf(pick: Pick, scale: number): Triple {
    const body = this.motion.bodies[pick.body]!;
    return body.toWorld(body.node(pick.node, scale));
  }

  private showDots(picks: { pick: Pick; color: string }[], scale: number): void {
    while (this.dots.length < picks.length) {
      const dot = ball(new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }));
      dot.renderOrder = 5;
      this.dots.push(dot);
    }
    this.dots.forEach((dot, i) => {
      const shown = picks[i];
      dot.visible = shown !== undefined;
      if (!shown) return;
      if (dot.parent !== this.model) this.model.add(dot);
      (dot.material as THREE.MeshBasicMaterial).color.set(shown.color);
      const at = this.placeOf(shown.pick, scale);
      dot.position.set(...at);
      dot.scale.setScalar(5 * this.pixelSize(at));
    });
  }

  /** Length of a CSS pixel at a world point [m]. */
  private pixelSize(at: Triple): number {
    const { camera } = this.rig;
    if (camera instanceof THREE.OrthographicCamera) {
      return ((camera.top - camera.bottom) / camera.zoom / this.height) * this.bounds.size;
    }
    this.model.updateMatrixWorld();
    const p = new THREE.Vector3(...at).applyMatrix4(this.model.matrixWorld);
    const tangent = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    const distance = camera.position.distanceTo(p);
    return ((2 * tangent * distance) / this.height) * this.bounds.size;
  }

  /** The node under a point of the canvas [CSS px]; null for none. */
  pick(x: number, y: number): Omit<Pick, 'pane'> | null {
    const place = new THREE.Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height);
    const ray = new THREE.Raycaster();
    this.scene.updateMatrixWorld();
    ray.setFromCamera(place, this.rig.camera);
    return pickAlong(ray, this.bodies);
  }

  /** Canvas position of a world point [CSS px]. */
  project(p: Triple): { x: number; y: number } {
    this.model.updateMatrixWorld();
    const q = new THREE.Vector3(...p).applyMatrix4(this.model.matrixWorld).project(this.rig.camera);
    return { x: ((q.x + 1) / 2) * this.width, y: ((1 - q.y) / 2) * this.height };
  }

  private showLabels(options: ViewOptions, picks: { pick: Pick; color: string }[]): void {
    const labels: Label[] = this.corner.tips.map(({ text, at, color }) => {
      const [x, y] = this.corner.project(at);
      return { text, kind: 'axis', color, x: x * kCorner, y: this.height - kCorner + y * kCorner };
    });
    for (const { pick } of picks) {
      const text = pickName(this.run.bodies[pick.body]!, pick);
      const at = this.project(this.placeOf(pick, options.scale));
      labels.push({ text, kind: 'marker', ...at });
    }
    if (options.reactions) {
      for (const view of this.reactions) {
        const at = this.project(view.position(options.scale));
        if (view.text) labels.push({ text: view.text, kind: 'marker', ...at });
      }
    }
    if (options.labels) {
      labels.push(...this.nameLabels(options));
    }
    this.labels.show(labels, this.width, this.height);
  }

  /** Names within the picture; of more than can be read some, evenly spread. */
  private nameLabels(options: ViewOptions): Label[] {
    const { loads, motion } = this;
    const joints = this.crowd?.namedJoints() ?? this.joints;
    const all = namesOf(motion, { joints, loads }, this.theme, options)
      .map((name) => ({ ...name, ...this.project(name.at) }))
      .filter(({ x, y }) => x >= 0 && y >= 0 && x <= this.width && y <= this.height);
    return spread(all, kMostNames);
  }
}
