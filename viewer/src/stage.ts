import * as THREE from 'three';
import { BodyView, type GlyphSize } from './body_view';
import { runBounds, type Bounds } from './bounds';
import { CameraRig } from './camera_rig';
import { CornerTriad } from './corner_triad';
import { Grid } from './grid';
import { JointView } from './joint_view';
import { Labels, type Label } from './labels';
import { Motion } from './motion';
import { orientationOf, type Orientation } from './orientation';
import { Trace } from './trace';
import { largestStress, type Run } from './run';
import type { Theme } from './theme';
import type { Triple } from './page_data';
import type { ViewOptions } from './view_options';

/** Edge of the corner with the world axes [CSS px]. */
const kCorner = 92;

/** The 3-D view of a run, the model scaled to unit size: every model gets the same depth range. */
export class Stage {
  readonly canvas = document.createElement('canvas');
  readonly labels = new Labels();
  readonly bounds: Bounds;
  readonly rig: CameraRig;
  readonly motion: Motion;
  /** Largest stress of the run, the top of the colour scale [Pa]; 0 without stresses. */
  readonly stressRange: number;
  gridSpacing = 0;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly model = new THREE.Group();
  private readonly orientation: Orientation;
  private readonly corner: CornerTriad;
  private readonly trace: Trace;
  private readonly glyphs: GlyphSize;
  private theme!: Theme;
  private bodies: BodyView[] = [];
  private joints: JointView[] = [];
  private width = 1;
  private height = 1;

  /** Throws if the browser has no WebGL. `changed` is called whenever the camera moves. */
  constructor(
    private readonly run: Run,
    theme: Theme,
    changed: () => void,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true });
    this.motion = new Motion(run);
    this.bounds = runBounds(run);
    this.orientation = orientationOf(run);
    this.glyphs = {
      joint: 0.016 * Math.min(this.bounds.size, this.bounds.machine),
      leastRadius: 0.0022 * this.bounds.size,
    };
    this.stressRange = largestStress(run);
    this.corner = new CornerTriad(run.gravity);
    this.trace = new Trace(run, this.bounds.center);
    const scale = 1 / this.bounds.size;
    this.model.scale.setScalar(scale);
    this.model.position.set(...this.bounds.center).multiplyScalar(-scale);
    this.scene.add(this.model, new THREE.HemisphereLight(0xffffff, 0xb4bcc6, 2.1));
    this.rig = new CameraRig(this.canvas, this.orientation.up, run.planar !== null, changed);
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('aria-label', '3-D view of the model. Drag to turn, wheel to zoom.');
    const headlight = new THREE.DirectionalLight(0xffffff, 1.7);
    headlight.name = 'headlight';
    this.scene.add(headlight, headlight.target);
    this.setTheme(theme);
  }

  /** Builds everything drawn anew in the colours of `theme`. */
  setTheme(theme: Theme): void {
    this.theme = theme;
    this.scene.background = new THREE.Color(theme.background);
    this.model.traverse((part) => {
      if (part instanceof THREE.Mesh || part instanceof THREE.Line) part.geometry.dispose();
    });
    this.model.clear();
    const { run, glyphs, orientation } = this;
    const grid = new Grid(this.bounds, orientation, run.planar !== null, theme);
    this.gridSpacing = grid.spacing;
    this.bodies = this.motion.bodies.map((motion, i) => {
      const color = theme.bodies[i % theme.bodies.length]!;
      return new BodyView(motion, color, theme, glyphs);
    });
    this.joints = run.joints.map(
      (joint) => new JointView(joint, this.motion, theme, glyphs, orientation.up),
    );
    this.model.add(grid.root, this.trace.root);
    for (const view of [...this.bodies, ...this.joints]) this.model.add(view.root);
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(this.width, this.height, false);
    this.rig.resize(this.width, this.height);
  }

  /** Looks at the whole run, from `back` or from where the camera is. */
  fit(back?: Triple): void {
    // Glyphs stand out beyond the points they mark.
    const margin = 3.5 * this.glyphs.joint;
    const half = this.bounds.half.map((h) => (h + margin) / this.bounds.size) as Triple;
    this.rig.fit(half, back);
  }

  fitHome(): void {
    this.fit(this.orientation.back);
  }

  render(t: number, options: ViewOptions): void {
    this.motion.setTime(t);
    this.bodies.forEach((body) => body.update(options, this.stressRange));
    for (const joint of this.joints) {
      joint.root.visible = options.joints;
      if (options.joints) joint.update(options.scale);
    }
    const { index, fraction } = this.motion.place;
    const color = options.trace
      ? this.theme.bodies[options.trace.body % this.theme.bodies.length]!
      : '';
    this.trace.update(options.trace, options.scale, index + (fraction > 0.5 ? 1 : 0), color);
    this.trace.resize(this.width, this.height);
    this.aimHeadlight();
    this.renderer.render(this.scene, this.rig.camera);
    this.corner.render(this.renderer, this.rig.camera, kCorner);
    this.showLabels(options);
  }

  private aimHeadlight(): void {
    const light = this.scene.getObjectByName('headlight')!;
    light.position.set(-0.5, 0.8, 1).applyQuaternion(this.rig.camera.quaternion);
  }

  /** Canvas place of a world point [CSS px]. */
  project(p: Triple): { x: number; y: number } {
    this.model.updateMatrixWorld();
    const q = new THREE.Vector3(...p).applyMatrix4(this.model.matrixWorld).project(this.rig.camera);
    return { x: ((q.x + 1) / 2) * this.width, y: ((1 - q.y) / 2) * this.height };
  }

  private showLabels(options: ViewOptions): void {
    const labels: Label[] = this.corner.tips.map(({ text, at, color }) => {
      const [x, y] = this.corner.project(at);
      return { text, kind: 'axis', color, x: x * kCorner, y: this.height - kCorner + y * kCorner };
    });
    if (options.labels) labels.push(...this.names(options));
    this.labels.show(labels, this.width, this.height);
  }

  private names(options: ViewOptions): Label[] {
    const names: Label[] = [];
    this.motion.bodies.forEach((motion, i) => {
      const { body } = motion;
      const middle = body.elements.length > 0 && body.kind === 'beam';
      const at = middle ? motion.node(Math.floor(body.nodes.length / 2), options.scale) : [0, 0, 0];
      const color = this.theme.bodies[i % this.theme.bodies.length]!;
      names.push({ text: body.name, kind: 'body', color, ...this.project(motion.toWorld(at)) });
    });
    if (options.joints) {
      this.run.joints.forEach((joint, i) => {
        const at = this.joints[i]!.position(options.scale);
        names.push({ text: joint.name, kind: 'joint', ...this.project(at) });
      });
    }
    if (options.frames) {
      for (const motion of this.motion.bodies) {
        for (const marker of motion.body.markers) {
          const at = motion.toWorld(motion.marker(marker, options.scale));
          const text = `${motion.body.name}/${marker.name}`;
          names.push({ text, kind: 'marker', ...this.project(at) });
        }
      }
    }
    return names;
  }
}
