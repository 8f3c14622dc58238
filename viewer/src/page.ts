import { Charts } from './charts';
import { el } from './dom';
import { header } from './header';
import { Playback } from './playback';
import { figure, prefixFor } from './quantity';
import { Stage } from './stage';
import { StressLegend } from './stress_legend';
import { currentTheme, onThemeChange } from './theme';
import { Toolbar } from './toolbar';
import { Transport } from './transport';
import type { Run } from './run';
import type { Triple } from './page_data';
import type { ViewOptions } from './view_options';

const kKeys: [string, string][] = [
  ['space', 'play, pause'],
  ['← →', 'one stored frame (with shift ten)'],
  ['home, end', 'begin, end'],
  ['f', 'fit: the whole run in view'],
  ['o', 'orthographic or perspective'],
  ['j b l u s', 'joints, frames, names, undeformed, stress'],
  ['drag', 'turn; right button or shift: move; wheel: zoom'],
  ['click in a curve', 'go to that time'],
];

/** The page: puts the parts together, keeps them at the same time, draws only when something changed. */
export class Page {
  private readonly options: ViewOptions;
  private readonly playback: Playback;
  private readonly charts: Charts;
  private readonly transport: Transport;
  private readonly toolbar: Toolbar;
  private readonly view = el('div', { class: 'view' });
  private readonly side: HTMLElement;
  private readonly projection = el('button', { type: 'button', click: () => this.project() });
  private readonly gridText = el('div', { class: 'grid-text' });
  private readonly help = this.helpDialog();
  private stage: Stage | null = null;
  private legend: StressLegend | null = null;
  private dirty = true;
  private last = 0;
  private drawn = 0;

  constructor(app: HTMLElement, private readonly run: Run) {
    const stressed = run.bodies.some((body) => body.stress?.some((value) => value > 0));
    this.options = {
      frames: false, joints: true, labels: false, undeformed: false, stress: stressed, scale: 1, trace: null,
    };
    const changed = () => this.changed();
    this.playback = new Playback(run.times);
    const theme = currentTheme();
    this.charts = new Charts(run, theme, (t) => this.seek(t));
    this.toolbar = new Toolbar(run, this.options, changed);
    const deformable = run.bodies.some((body) => body.displacement);
    this.transport = new Transport(this.playback, this.options, deformable, changed);
    this.side = el('aside', { class: 'side', 'aria-label': 'Curves' }, this.curveChoice(), this.charts.root);
    const middle = el('section', { class: 'middle' }, this.view, this.transport.root);
    app.append(header(run), el('main', { class: 'workspace' }, middle, this.side), this.help);
    this.addStage();
    this.notice();
    this.charts.layOut();
    this.watch();
    this.playback.playing =
      this.playback.canPlay && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    requestAnimationFrame((now) => this.tick(now));
  }

  private addStage(): void {
    const changed = () => this.changed();
    try {
      this.stage = new Stage(this.run, currentTheme(), changed);
    } catch (error) {
      const text = `The 3-D view needs WebGL, which this browser does not offer (${String(error)}).`;
      this.view.append(el('p', { class: 'notice' }, text));
      return;
    }
    const axes: [string, Triple][] = [['X', [1, 0, 0]], ['Y', [0, 1, 0]], ['Z', [0, 0, 1]]];
    const views = axes.map(([name, back]) =>
      el('button', { type: 'button', title: `Seen from +${name}`, click: () => this.stage!.fit(back) }, name),
    );
    const spatial: Triple = [0.55, 0.45, 0.7];
    const corner = this.run.planar ? spatial : undefined;
    views.push(
      el('button', {
        type: 'button', title: 'Seen from the corner',
        click: () => (corner ? this.stage!.fit(corner) : this.stage!.fitHome()),
      }, '3D'),
      el('button', { type: 'button', 'data-fit': '', title: 'The whole run in view (f)', click: () => this.stage!.fitHome() }, 'Fit'),
      this.projection,
      el('button', { type: 'button', title: 'Keys and mouse (?)', click: () => this.help.showModal() }, '?'),
    );
    this.legend = new StressLegend(this.stage.stressRange);
    this.view.append(
      this.stage.canvas, this.stage.labels.root, this.toolbar.root,
      el('div', { class: 'toolbar right', role: 'toolbar', 'aria-label': 'Camera' }, ...views),
      this.legend.root, this.gridText,
    );
    const { factor, unit } = prefixFor(this.stage.gridSpacing, 'm');
    this.gridText.textContent = `grid ${figure(this.stage.gridSpacing / factor, 1)} ${unit}`;
    const box = this.view.getBoundingClientRect();
    this.stage.resize(box.width, box.height);
    this.stage.fitHome();
  }

  private notice(): void {
    let text = '';
    if (this.run.bodies.length === 0) text = 'This run has no bodies to draw.';
    else if (this.run.times.length === 1) text = 'The run stored one frame only: there is nothing to play.';
    else if (!this.playback.canPlay) text = 'All stored frames are at the same time: there is nothing to play.';
    if (text) this.view.append(el('p', { class: 'notice' }, text));
  }

  private curveChoice(): HTMLElement {
    const boxes = this.charts.names.map((name, i) => {
      const box = el('input', {
        type: 'checkbox', checked: this.charts.isShown(i),
        change: () => this.charts.show(i, box.checked),
      });
      return el('label', {}, box, name);
    });
    const unit = el('span', { class: 'unit' }, `time in ${this.charts.timeUnit}`);
    if (boxes.length === 0) return el('div', { class: 'side-head' }, el('h2', {}, 'Curves'));
    const choice = el('details', { class: 'choice' }, el('summary', {}, 'Choose'), el('div', {}, ...boxes));
    return el('div', { class: 'side-head' }, el('h2', {}, 'Curves'), unit, choice);
  }

  private helpDialog(): HTMLDialogElement {
    const rows = kKeys.map(([key, what]) => el('tr', {}, el('th', { scope: 'row' }, key), el('td', {}, what)));
    const dialog: HTMLDialogElement = el('dialog', { class: 'details', click: (e) => e.target === dialog && dialog.close() },
      el('header', {}, el('h2', {}, 'Keys and mouse'),
        el('button', { class: 'icon', 'aria-label': 'Close', click: () => dialog.close() }, '✕')),
      el('table', {}, ...rows));
    return dialog;
  }

  private project(): void {
    this.stage?.rig.setOrthographic(!this.stage.rig.orthographic);
    this.changed();
  }

  private watch(): void {
    new ResizeObserver(() => {
      this.stage?.resize(this.view.clientWidth, this.view.clientHeight);
      this.changed();
    }).observe(this.view);
    new ResizeObserver(() => this.charts.resize()).observe(this.charts.root);
    onThemeChange((theme) => {
      this.stage?.setTheme(theme);
      this.charts.setTheme(theme);
      this.changed();
    });
    window.addEventListener('keydown', (event) => this.key(event));
    window.__buckens = {
      setTime: (t) => this.seek(t),
      state: () => this.state(),
    };
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector('dialog[open]')) return;
    const target = event.target as HTMLElement;
    const range = target instanceof HTMLInputElement && target.type === 'range';
    const typing = target.matches('input, select, textarea') && !range;
    if (typing || (event.key === ' ' && target.matches('button, summary'))) return;
    const arrows = /^(Arrow|Home|End|Page)/.test(event.key);
    if (range && arrows) return;
    if (this.act(event.key, event.shiftKey)) event.preventDefault();
  }

  private act(key: string, shift: boolean): boolean {
    const frames = shift ? 10 : 1;
    switch (key) {
      case ' ': this.transport.toggle(); return true;
      case 'ArrowLeft': return this.step(() => this.playback.stepFrames(-frames));
      case 'ArrowRight': return this.step(() => this.playback.stepFrames(frames));
      case 'Home': return this.step(() => this.playback.setTime(this.playback.start));
      case 'End': return this.step(() => this.playback.setTime(this.playback.end));
      case 'f': this.stage?.fitHome(); return true;
      case 'o': this.project(); return true;
      case '?': this.help.showModal(); return true;
      default: return this.toolbar.key(key);
    }
  }

  private step(move: () => void): boolean {
    this.playback.playing = false;
    move();
    this.changed();
    return true;
  }

  private seek(t: number): void {
    this.step(() => this.playback.setTime(t));
  }

  private changed(): void {
    this.dirty = true;
  }

  private tick(now: number): void {
    // A tab that slept must not jump: at most a tenth of a second passes between two pictures.
    this.playback.advance(Math.min(0.1, Math.max(0, (now - this.last) / 1000)));
    this.last = now;
    if (this.dirty || this.playback.playing) this.draw();
    requestAnimationFrame((next) => this.tick(next));
  }

  private draw(): void {
    this.dirty = false;
    this.drawn++;
    const { stage, options, playback } = this;
    this.transport.update();
    this.toolbar.update();
    this.charts.setTime(playback.time);
    if (!stage) return;
    this.projection.textContent = stage.rig.orthographic ? 'Parallel' : 'Perspective';
    this.projection.title = 'Change the projection (o)';
    stage.render(playback.time, options);
    const stresses = stage.motion.bodies.flatMap((body) => Array.from(body.stress));
    this.legend!.update(options.stress && stage.stressRange > 0, Math.max(0, ...stresses));
  }

  /** What is on the screen, in plain numbers; see docs/tutorials/viewer.md. */
  private state(): ViewerState {
    // Draws first, so that a test never reads the picture before last.
    if (this.dirty) this.draw();
    const { time, playing, speed } = this.playback;
    return {
      time, playing, speed, ...this.options,
      frame: this.stage?.motion.place.index ?? 0,
      orthographic: this.stage?.rig.orthographic ?? false,
      drawn: this.drawn,
      size: this.stage?.bounds.size ?? 0,
      cursors: this.charts.cursors(),
      bodies: (this.stage?.motion.bodies ?? []).map((motion) => ({
        name: motion.body.name,
        pose: [...motion.pose],
        screen: this.stage!.project(motion.toWorld([0, 0, 0])),
      })),
    };
  }
}

/** Answer of `window.__buckens.state()`. */
export interface ViewerState extends ViewOptions {
  time: number;
  playing: boolean;
  speed: number;
  frame: number;
  orthographic: boolean;
  /** Pictures drawn so far. */
  drawn: number;
  size: number;
  cursors: { name: string; x: number }[];
  bodies: { name: string; pose: number[]; screen: { x: number; y: number } }[];
}

declare global {
  interface Window {
    /** For tests and scripts: `setTime` pauses and shows time t [s]. */
    __buckens?: { setTime(t: number): void; state(): ViewerState };
  }
}
