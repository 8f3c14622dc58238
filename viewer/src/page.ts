import { CameraBar } from './camera_bar';
import { Capture } from './capture';
import { Captions, notice } from './captions';
import { allTimes, valueAt } from './chart';
import { Charts } from './charts';
import { curveChoice } from './curve_choice';
import { DisplayPanel } from './display_panel';
import { el } from './dom';
import { FieldPanel } from './field_panel';
import { FieldShading } from './field_material';
import { rangeOfRun, visibleScale } from './field_values';
import { fieldItems } from './fields';
import { header } from './header';
import { insetsOf } from './insets';
import { Keyboard } from './keyboard';
import { joined, runBounds } from './bounds';
import { Magnitudes } from './magnitudes';
import { ModeList } from './mode_list';
import { pageState } from './page_state';
import { PickPanel } from './pick_panel';
import { historyAt } from './picks';
import { Playback } from './playback';
import { TimeFormat } from './quantity';
import { namesOfRuns, titleOf } from './run_names';
import { Section } from './section';
import { startOptions } from './start_options';
import { currentTheme, nextTheme, onThemeChange, themeChoice, type Theme } from './theme';
import { Toolbar } from './toolbar';
import { Transport } from './transport';
import { Views } from './views';
import type { ModeShapes } from './modes';
import type { Run } from './run';
import type { Kept, ViewerState } from './hook';
import type { ViewOptions } from './view_options';

/** Seconds for which one period of a mode is shown. */
const kPeriodWatch = 2;

/** The page: assembles the parts and keeps them at the same time. */
export class Page {
  private readonly runs: Run[];
  private readonly options: ViewOptions;
  private readonly playback: Playback;
  private readonly shading = new FieldShading();
  private readonly charts: Charts;
  private readonly transport: Transport;
  private readonly toolbar: Toolbar;
  private readonly display: DisplayPanel;
  private readonly field: FieldPanel;
  private readonly picks: PickPanel;
  private readonly camera: CameraBar;
  private readonly keyboard: Keyboard;
  private readonly views: Views;
  private readonly view = el('div', { class: 'view' });
  private readonly captions = new Captions();
  private readonly modeList: ModeList | null = null;
  private theme: Theme = currentTheme();
  private dirty = true;
  private last = 0;
  private drawn = 0;
  private itemShown = '';
  private readonly capture: Capture;

  /** @param shapes one per run on pages with vibrations */
  constructor(
    app: HTMLElement,
    stored: Run[],
    private readonly shapes: ModeShapes[] = [],
  ) {
    const runs = shapes.length ? shapes.map((shape) => shape.run) : stored;
    this.runs = runs;
    const items = fieldItems(runs);
    const times = allTimes(runs);
    this.options = startOptions(items, times.length === 1 && shapes.length === 0);
    const changed = () => this.changed();
    this.playback = new Playback(times);
    const bounds = runs.map(runBounds).reduce(joined);
    const magnitudes = new Magnitudes(runs, bounds.size);
    const least = (unit: string) => magnitudes.least(unit);
    const charted = shapes.length ? [] : runs;
    this.charts = new Charts(charted, times, this.theme, (t) => this.seek(t), least);
    this.keyboard = this.keys();
    this.camera = new CameraBar({
      lookAlong: (axis) => this.views.lookAlong(axis),
      fit: () => this.leader?.fit(),
      project: () => this.views.project(),
      picture: () => this.capture.picture(),
      video: () => this.flipVideo(),
      theme: nextTheme,
      help: () => this.keyboard.help.showModal(),
    });
    const titles = runs.length > 1 ? namesOfRuns(runs) : [''];
    this.views = new Views(runs, titles, bounds, this.theme, this.shading, {
      changed,
      picked: (pick) => this.picks.flip(pick),
    });
    const section = this.leader?.section ?? new Section(bounds, []);
    this.display = new DisplayPanel(runs[0]!, this.options, section, changed);
    this.toolbar = new Toolbar(runs, this.options, this.display.root, changed);
    const range = (id: string) => {
      const unit = items.find((item) => item.id === id)?.unit ?? '';
      return magnitudes.visible(rangeOfRun(runs, id), unit);
    };
    this.field = new FieldPanel(items, this.options, this.shading, range, changed);
    this.picks = new PickPanel(
      runs,
      {
        position: (pick) =>
          shapes.length ? this.views.restingPlaceOf(pick) : this.views.placeOf(pick),
        atRest: shapes.length > 0,
        least: (unit) => magnitudes.least(unit),
        history: (pick) =>
          historyAt(runs[pick.pane]!, pick, this.options.field.item, this.options.field.perElement),
        item: () => this.field.itemShown,
      },
      (content) => {
        this.charts.setExtra(content);
        this.changed();
      },
    );
    const format = new TimeFormat(this.playback.duration, runs[0]!.clock);
    this.capture = new Capture(this.views, {
      title: titleOf(runs),
      time: () => (shapes.length ? '' : `${format.number(this.playback.time)} ${format.unit}`),
      background: () => this.theme.background,
      ink: () => (this.theme.dark ? '#e5eaf1' : '#1b2430'),
      redraw: () => this.draw(),
    });
    // The amplitude of a mode replaces the deformation scale.
    const bodies = runs.flatMap((run) => run.bodies);
    const deformable = !shapes.length && bodies.some((body) => body.displacement);
    const { clock } = runs[0]!;
    const scale = () => visibleScale(runs, bounds.machine);
    const { playback, options } = this;
    this.transport = new Transport(playback, clock, options, deformable, changed, scale);
    if (shapes.length) this.modeList = new ModeList(shapes, () => this.restart());
    this.assemble(app);
    this.watch();
    if (shapes.length) this.restart();
    this.playback.playing =
      this.playback.canPlay && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    requestAnimationFrame((now) => this.tick(now));
  }

  private get leader() {
    return this.views.leader;
  }

  private assemble(app: HTMLElement): void {
    const curves = this.modeList ? [this.modeList.root] : [curveChoice(this.charts)];
    const label = this.modeList ? 'Modes' : 'Curves';
    const side = el('aside', { class: 'side', 'aria-label': label }, ...curves);
    if (this.modeList) side.classList.add('modes');
    side.append(this.charts.root, this.picks.root);
    if (this.views.panes.length > 1) this.view.classList.add('both');
    const panes = el('div', { class: 'panes' }, ...this.views.panes.map((pane) => pane.root));
    const bars = el('div', { class: 'bars' }, this.toolbar.root, this.camera.root);
    const overlay = el('div', { class: 'overlay' }, bars, this.field.root);
    this.view.append(panes, overlay, this.captions.corner, this.captions.status);
    const middle = el('section', { class: 'middle' }, this.view, this.transport.root);
    const workspace = el('main', { class: 'workspace' }, middle, side);
    app.append(header(this.runs), workspace, this.keyboard.help);
    const note = notice(this.runs[0]!, this.views.panes, this.playback);
    if (note) this.view.append(el('p', { class: 'notice' }, note));
    this.field.update([NaN, NaN]);
    this.makeRoom();
    for (const pane of this.views.panes) pane.stage?.fitHome();
    this.charts.layOut();
  }

  /** Fits the pictures into the area not covered by controls. */
  private makeRoom(): void {
    const insets = insetsOf(this.view, this.field.root, this.views.panes.length > 1);
    this.views.resize(insets);
  }

  private keys(): Keyboard {
    const step = (frames: number) => this.step(() => this.playback.stepFrames(frames));
    return new Keyboard({
      toggle: () => this.transport.toggle(),
      stepFrames: step,
      toStart: () => this.seek(this.playback.start),
      toEnd: () => this.seek(this.playback.end),
      fit: () => this.leader?.fit(),
      zoom: (factor) => this.leader?.rig.zoom(factor),
      turn: (aside, up) => this.leader?.rig.turn(aside, up),
      move: (aside, up) => this.leader?.rig.move(aside, up),
      lookAlong: (axis) => this.views.lookAlong(axis),
      deform: (factor) => this.transport.setScale(this.options.scale * factor),
      nextField: (steps) => this.field.step(steps),
      project: () => this.views.project(),
      other: (key) => this.otherKey(key),
    });
  }

  private otherKey(key: string): boolean {
    if (this.modeList && (key === 'ArrowUp' || key === 'ArrowDown')) {
      this.modeList.step(key === 'ArrowUp' ? -1 : 1);
      return true;
    }
    if (key === 'e') this.display.nextEdges();
    else if (key === 'x') this.display.nextAxis();
    else if (key === 't') nextTheme();
    else if (key === 'p') this.capture.picture();
    else if (key === 'm') this.flipVideo();
    else if (key === 'Escape') return this.display.close();
    else return this.toolbar.key(key);
    return true;
  }

  /** Records the run once from its begin, unless a recording is to end. */
  private flipVideo(): void {
    if (this.capture.isRecording) {
      this.capture.end();
    } else {
      this.playback.setTime(this.playback.start);
      this.playback.playing = this.playback.canPlay;
      this.capture.begin();
    }
    this.changed();
  }

  private watch(): void {
    new ResizeObserver(() => {
      this.makeRoom();
      this.changed();
    }).observe(this.view);
    new ResizeObserver(() => this.charts.resize()).observe(this.charts.root);
    onThemeChange((theme) => {
      this.theme = theme;
      this.views.setTheme(theme);
      this.charts.setTheme(theme);
      this.changed();
    });
    window.__buckens = {
      setTime: (t) => this.seek(t),
      state: () => this.state(),
      keep: () => this.keep(),
      adopt: (kept) => this.adopt(kept),
    };
  }

  private keep(): Kept {
    const { options, playback, leader } = this;
    return {
      options,
      time: playback.time,
      isAtEnd: playback.time >= playback.end,
      playing: playback.playing,
      speed: playback.speed,
      camera: leader?.rig.keep() ?? null,
    };
  }

  private adopt(kept: Kept): void {
    const { options, playback } = this;
    // Its parts are known elsewhere and stay the same objects.
    const { field, section, ...rest } = structuredClone(kept.options);
    Object.assign(options, rest);
    Object.assign(options.field, field);
    Object.assign(options.section, section);
    playback.speed = kept.speed;
    playback.playing = kept.playing && playback.canPlay;
    playback.setTime(kept.isAtEnd && !kept.playing ? playback.end : kept.time);
    if (kept.camera) this.leader?.rig.adopt(kept.camera);
    this.changed();
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

  /** Another mode or amplitude: its period replaces the run. */
  private restart(): void {
    this.transport.restart(kPeriodWatch);
    this.field.forget();
    for (const { stage } of this.views.panes) stage?.forget();
    this.picks.refresh();
    this.changed();
  }

  private tick(now: number): void {
    // A suspended tab must not jump: at most a tenth of a second passes between two pictures.
    const before = this.playback.time;
    this.playback.advance(Math.min(0.1, Math.max(0, (now - this.last) / 1000)));
    if (this.capture.isRecording && this.playback.time < before) {
      // Once through: the end is its last picture.
      this.playback.playing = false;
      this.playback.setTime(this.playback.end);
      this.capture.endSoon();
      this.changed();
    }
    this.last = now;
    if (this.dirty || this.playback.playing) this.draw();
    requestAnimationFrame((next) => this.tick(next));
  }

  private draw(): void {
    this.dirty = false;
    this.drawn++;
    const { options, playback, leader } = this;
    this.followField();
    this.transport.update();
    this.toolbar.update();
    this.display.update();
    this.charts.setTime(playback.time);
    if (!leader) return;
    this.camera.update(leader.rig.orthographic, themeChoice(), this.capture.isRecording);
    for (const { stage } of this.views.panes) stage?.update(playback.time, options);
    const hidden = this.field.root.hidden;
    this.field.update(this.views.present());
    if (this.field.root.hidden !== hidden) this.makeRoom();
    this.views.panes.forEach(({ stage }, pane) => {
      const colors = this.theme.curves;
      const own = this.picks.picks
        .map((pick, i) => ({ pick, color: colors[i % colors.length]! }))
        .filter(({ pick }) => pick.pane === pane);
      stage?.render(options, own);
    });
    const { size } = leader.bounds;
    this.picks.update((curve) => valueAt(curve, playback.time), this.theme.curves, size);
    const shown = options.colors ? this.field.itemShown?.label : '';
    this.captions.update(this.views.panes, options, playback, shown ?? '');
    this.capture.take();
  }

  /** Another field is shown: the curves at nodes change to its quantity. */
  private followField(): void {
    const { item, perElement } = this.options.field;
    const shown = `${item} ${perElement}`;
    if (shown === this.itemShown) return;
    if (this.itemShown && this.picks.picks.length > 0) this.picks.refresh();
    this.itemShown = shown;
    this.dirty = false;
  }

  private state(): ViewerState {
    // Draws first, so that a test never reads the picture before last.
    if (this.dirty) this.draw();
    return pageState({
      runs: this.runs,
      options: this.options,
      playback: this.playback,
      panes: this.views.panes,
      shapes: this.shapes,
      picks: this.picks.picks,
      cursors: this.charts.cursors(),
      present: this.leader ? this.views.present() : [NaN, NaN],
      drawn: this.drawn,
    });
  }
}
