import { Charts } from './charts';
import { curveChoice } from './curve_choice';
import { el } from './dom';
import { header } from './header';
import { Keyboard } from './keyboard';
import { ModeList } from './mode_list';
import { Playback } from './playback';
import { figure, prefixFor } from './quantity';
import { Stage } from './stage';
import { StressLegend } from './stress_legend';
import { currentTheme, onThemeChange } from './theme';
import { Toolbar } from './toolbar';
import { Transport } from './transport';
import type { ModeShapes } from './modes';
import { largestStress, type Run } from './run';
import type { ViewerState } from './hook';
import type { Triple } from './page_data';
import type { ViewOptions } from './view_options';

/** Seconds a person watches one period of a mode. */
const kPeriodWatch = 2;

/** The page: puts the parts together and keeps them at the same time. */
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
  private readonly keyboard: Keyboard;
  private stage: Stage | null = null;
  private legend: StressLegend | null = null;
  private readonly modeList: ModeList | null = null;
  private readonly run: Run;
  private dirty = true;
  private last = 0;
  private drawn = 0;

  constructor(
    app: HTMLElement,
    stored: Run,
    private readonly shapes: ModeShapes | null = null,
  ) {
    const run = shapes?.run ?? stored;
    this.run = run;
    const stressed = largestStress(run) > 0;
    this.options = {
      frames: false,
      joints: true,
      labels: false,
      undeformed: false,
      stress: stressed,
      scale: 1,
      trace: null,
    };
    const changed = () => this.changed();
    this.playback = new Playback(run.times);
    const theme = currentTheme();
    this.charts = new Charts(run, theme, (t) => this.seek(t));
    this.keyboard = this.keys();
    this.toolbar = new Toolbar(run, this.options, changed);
    // The amplitude of a mode takes the place of the deformation scale.
    const deformable = !shapes && run.bodies.some((body) => body.displacement);
    this.transport = new Transport(this.playback, this.options, deformable, changed);
    if (shapes) this.modeList = new ModeList(shapes, () => this.restart());
    this.side =
      this.modeList?.root ??
      el(
        'aside',
        { class: 'side', 'aria-label': 'Curves' },
        curveChoice(this.charts),
        this.charts.root,
      );
    const middle = el('section', { class: 'middle' }, this.view, this.transport.root);
    app.append(
      header(run),
      el('main', { class: 'workspace' }, middle, this.side),
      this.keyboard.help,
    );
    this.addStage();
    this.notice();
    this.charts.layOut();
    this.watch();
    if (shapes) this.restart();
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
    const axes: [string, Triple][] = [
      ['X', [1, 0, 0]],
      ['Y', [0, 1, 0]],
      ['Z', [0, 0, 1]],
    ];
    const views = axes.map(([name, back]) =>
      el(
        'button',
        { type: 'button', title: `Seen from +${name}`, click: () => this.stage!.fit(back) },
        name,
      ),
    );
    const spatial: Triple = [0.55, 0.45, 0.7];
    const corner = this.run.planar ? spatial : undefined;
    views.push(
      el(
        'button',
        {
          type: 'button',
          title: 'Seen from the corner',
          click: () => (corner ? this.stage!.fit(corner) : this.stage!.fitHome()),
        },
        '3D',
      ),
      el(
        'button',
        {
          type: 'button',
          'data-fit': '',
          title: 'The whole run in view (f)',
          click: () => this.stage!.fit(),
        },
        'Fit',
      ),
      this.projection,
      el(
        'button',
        {
          type: 'button',
          title: 'Keys and mouse (?)',
          click: () => this.keyboard.help.showModal(),
        },
        '?',
      ),
    );
    this.legend = new StressLegend(
      this.stage.stressRange,
      this.run.bodies.every((body) => body.stress === null),
    );
    this.view.append(
      this.stage.canvas,
      this.stage.labels.root,
      this.toolbar.root,
      el('div', { class: 'toolbar right', role: 'toolbar', 'aria-label': 'Camera' }, ...views),
      this.legend.root,
      this.gridText,
    );
    const box = this.view.getBoundingClientRect();
    this.stage.resize(box.width, box.height);
    this.stage.fitHome();
  }

  private notice(): void {
    const frames = this.run.times.length;
    let text = '';
    if (this.run.bodies.length === 0) text = 'This run has no bodies to draw.';
    else if (frames === 1) text = 'One stored frame only: there is nothing to play.';
    else if (!this.playback.canPlay) text = 'All frames are at one time: there is nothing to play.';
    if (text) this.view.append(el('p', { class: 'notice' }, text));
  }

  private keys(): Keyboard {
    const { playback } = this;
    return new Keyboard({
      toggle: () => this.transport.toggle(),
      stepFrames: (frames) => this.step(() => playback.stepFrames(frames)),
      toStart: () => this.seek(playback.start),
      toEnd: () => this.seek(playback.end),
      fit: () => this.stage?.fit(),
      project: () => this.project(),
      other: (key) => this.otherKey(key),
    });
  }

  private otherKey(key: string): boolean {
    if (this.modeList && (key === 'ArrowUp' || key === 'ArrowDown')) {
      this.modeList.step(key === 'ArrowUp' ? -1 : 1);
      return true;
    }
    return this.toolbar.key(key);
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
    window.__buckens = {
      setTime: (t) => this.seek(t),
      state: () => this.state(),
    };
  }

  private step(move: () => void): void {
    this.playback.playing = false;
    move();
    this.changed();
  }

  private seek(t: number): void {
    this.step(() => this.playback.setTime(t));
  }

  private changed(): void {
    this.dirty = true;
  }

  /** Another mode or amplitude: its period takes the place of the run. */
  private restart(): void {
    this.transport.restart(kPeriodWatch);
    this.changed();
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
    const { factor, unit } = prefixFor(stage.gridSpacing, 'm');
    const grid = `grid ${figure(stage.gridSpacing / factor, 1)} ${unit}`;
    const enlarged =
      options.scale > 1 ? `deformation × ${Number(options.scale.toPrecision(3))} · ` : '';
    this.gridText.textContent = enlarged + grid;
    this.legend!.update(options.stress && stage.stressRange > 0, stage.motion.largestStress);
  }

  private state(): ViewerState {
    // Draws first, so that a test never reads the picture before last.
    if (this.dirty) this.draw();
    const { time, playing, speed } = this.playback;
    return {
      time,
      playing,
      speed,
      ...this.options,
      frame: this.stage?.motion.place.index ?? 0,
      orthographic: this.stage?.rig.orthographic ?? false,
      drawn: this.drawn,
      size: this.stage?.bounds.size ?? 0,
      cursors: this.charts.cursors(),
      mode: this.shapes?.index ?? null,
      amplitude: this.shapes?.amplitude ?? null,
      bodies: (this.stage?.motion.bodies ?? []).map((motion) => ({
        name: motion.body.name,
        pose: [...motion.pose],
        screen: this.stage!.project(motion.toWorld([0, 0, 0])),
      })),
    };
  }
}
