import { CameraBar } from './camera_bar';
import { allTimes, valueAt } from './chart';
import { Charts } from './charts';
import { curveChoice } from './curve_choice';
import { DisplayPanel } from './display_panel';
import { el } from './dom';
import { FieldPanel } from './field_panel';
import { FieldShading } from './field_material';
import { fieldItems, rangeOfRun } from './fields';
import { header } from './header';
import { insetsOf } from './insets';
import { Keyboard } from './keyboard';
import { joined, runBounds } from './bounds';
import { Magnitudes } from './magnitudes';
import { ModeList } from './mode_list';
import { Pane } from './pane';
import { PickPanel } from './pick_panel';
import { rotate } from './motion';
import { historyAt, type Pick } from './picks';
import { Playback } from './playback';
import { figure, niceBelow, prefixFor } from './quantity';
import { namesOfRuns } from './run_names';
import { Section } from './section';
import { startOptions } from './start_options';
import { chooseTheme, currentTheme, onThemeChange, themeChoice, type Theme } from './theme';
import { Toolbar } from './toolbar';
import { Transport } from './transport';
import type { ModeShapes } from './modes';
import { nodeAt, type Run } from './run';
import type { ViewerState } from './hook';
import type { Triple } from './page_data';
import type { ViewOptions } from './view_options';

/** Seconds a person watches one period of a mode. */
const kPeriodWatch = 2;
const kAxes: Triple[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
/** Towards the camera, for planar models seen from the corner. */
const kCorner: Triple = [0.55, 0.45, 0.7];

/** The page: puts the parts together and keeps them at the same time. */
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
  private readonly panes: Pane[];
  private readonly view = el('div', { class: 'view' });
  private readonly gridText = el('div', { class: 'grid-text' });
  private readonly status = el('div', { class: 'unseen', role: 'status' });
  private readonly modeList: ModeList | null = null;
  private theme: Theme = currentTheme();
  private dirty = true;
  private last = 0;
  private drawn = 0;
  private itemShown = '';

  /** @param shapes one per run on pages with vibrations */
  constructor(
    app: HTMLElement,
    stored: Run[],
    private readonly shapes: ModeShapes[] = [],
  ) {
    const runs = shapes.length ? shapes.map((shape) => shape.run) : stored;
    this.runs = runs;
    const items = fieldItems(runs);
    this.options = startOptions(items);
    const changed = () => this.changed();
    const times = allTimes(runs);
    this.playback = new Playback(times);
    const bounds = runs.map(runBounds).reduce(joined);
    const magnitudes = new Magnitudes(runs, bounds.size);
    const least = (unit: string) => magnitudes.least(unit);
    this.charts = new Charts(
      shapes.length ? [] : runs,
      times,
      this.theme,
      (t) => this.seek(t),
      least,
    );
    this.keyboard = this.keys();
    this.camera = new CameraBar({
      lookAlong: (axis) => this.lookAlong(axis),
      fit: () => this.leader?.fit(),
      project: () => this.project(),
      theme: () => this.nextTheme(),
      help: () => this.keyboard.help.showModal(),
    });
    const names = namesOfRuns(runs);
    this.panes = runs.map((run, i) => {
      const title = runs.length > 1 ? names[i]! : '';
      const moved = () => this.moved(i);
      return new Pane(run, title, bounds, this.theme, this.shading, moved, (pick) => {
        if (pick) this.picks.flip({ ...pick, pane: i });
      });
    });
    const section = this.leader?.section ?? new Section(bounds, []);
    this.display = new DisplayPanel(runs[0]!, this.options, section, changed);
    this.toolbar = new Toolbar(runs, this.options, this.display.root, changed);
    const range = (id: string): [number, number] => {
      const [low, high] = rangeOfRun(runs, id);
      const unit = items.find((item) => item.id === id)?.unit ?? '';
      const none = Math.max(Math.abs(low), Math.abs(high)) < magnitudes.least(unit);
      return none ? [0, 0] : [low, high];
    };
    this.field = new FieldPanel(items, this.options, this.shading, range, changed);
    this.picks = new PickPanel(
      runs,
      {
        position: (pick) => this.place(pick),
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
    // The amplitude of a mode takes the place of the deformation scale.
    const bodies = runs.flatMap((run) => run.bodies);
    const deformable = !shapes.length && bodies.some((body) => body.displacement);
    const { clock } = runs[0]!;
    this.transport = new Transport(this.playback, clock, this.options, deformable, changed, () => {
      const most = rangeOfRun(runs, 'displacement/magnitude')[1];
      return most > 0 ? Math.max(1, niceBelow((0.05 * bounds.machine) / most)) : 1;
    });
    if (shapes.length) this.modeList = new ModeList(shapes, () => this.restart());
    this.assemble(app);
    this.watch();
    if (shapes.length) this.restart();
    this.playback.playing =
      this.playback.canPlay && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Where a followed node is [m]; in vibrations, whose size is arbitrary, where it rests. */
  private place(pick: Pick): Triple {
    const stage = this.panes[pick.pane]!.stage;
    if (!stage || this.shapes.length === 0) return stage?.placeOf(pick, 1) ?? [NaN, NaN, NaN];
    const body = this.runs[pick.pane]!.bodies[pick.body]!;
    const turned = rotate(body.pose, 3, nodeAt(body, pick.node));
    return turned.map((x, i) => x + body.pose[i]!) as Triple;
  }

  /** The view whose camera the others follow. */
  private get leader() {
    return this.panes[0]!.stage;
  }

  private assemble(app: HTMLElement): void {
    const curves = this.modeList ? [this.modeList.root] : [curveChoice(this.charts)];
    const label = this.modeList ? 'Modes' : 'Curves';
    const side = el('aside', { class: 'side', 'aria-label': label }, ...curves);
    if (this.modeList) side.classList.add('modes');
    side.append(this.charts.root, this.picks.root);
    if (this.panes.length > 1) this.view.classList.add('both');
    const panes = el('div', { class: 'panes' }, ...this.panes.map((pane) => pane.root));
    const bars = el('div', { class: 'bars' }, this.toolbar.root, this.camera.root);
    const overlay = el('div', { class: 'overlay' }, bars, this.field.root);
    this.view.append(panes, overlay, this.gridText, this.status);
    const middle = el('section', { class: 'middle' }, this.view, this.transport.root);
    const workspace = el('main', { class: 'workspace' }, middle, side);
    app.append(header(this.runs), workspace, this.keyboard.help);
    this.notice();
    this.field.update([NaN, NaN]);
    this.makeRoom();
    for (const pane of this.panes) pane.stage?.fitHome();
    this.charts.layOut();
  }

  /** Fits the pictures to what the controls over them leave free. */
  private makeRoom(): void {
    const insets = insetsOf(this.view, this.field.root, this.panes.length > 1);
    for (const pane of this.panes) pane.resize(insets);
  }

  private notice(): void {
    const [run] = this.runs;
    const fault = this.panes.find((pane) => pane.fault)?.fault;
    let text = '';
    if (fault) text = `The 3-D view needs WebGL, which this browser does not offer (${fault}).`;
    else if (run!.bodies.length === 0) text = 'This run has no bodies to draw.';
    else if (run!.times.length === 1) text = 'One stored frame only: there is nothing to play.';
    else if (!this.playback.canPlay) text = 'All frames are at one time: there is nothing to play.';
    if (text) this.view.append(el('p', { class: 'notice' }, text));
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
      lookAlong: (axis) => this.lookAlong(axis),
      deform: (factor) => this.transport.setScale(this.options.scale * factor),
      nextField: (steps) => this.field.step(steps),
      project: () => this.project(),
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
    else if (key === 't') this.nextTheme();
    else if (key === 'Escape') return this.display.close();
    else return this.toolbar.key(key);
    return true;
  }

  private lookAlong(axis: number): void {
    if (axis >= 0) this.leader?.fit(kAxes[axis]);
    else if (this.runs[0]!.planar) this.leader?.fit(kCorner);
    else this.leader?.fitHome();
  }

  private project(): void {
    this.leader?.rig.setOrthographic(!this.leader.rig.orthographic);
    this.changed();
  }

  private nextTheme(): void {
    const next = { auto: 'light', light: 'dark', dark: 'auto' } as const;
    chooseTheme(next[themeChoice()]);
  }

  /** The camera of one view has moved: the others look from there too. */
  private moved(index: number): void {
    const from = this.panes?.[index]?.stage;
    if (from) {
      for (const { stage } of this.panes) if (stage && stage !== from) stage.rig.follow(from.rig);
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
      for (const pane of this.panes) pane.stage?.setTheme(theme);
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
    this.field.forget();
    for (const { stage } of this.panes) stage?.forget();
    this.picks.refresh();
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
    const { options, playback, leader } = this;
    this.followField();
    this.transport.update();
    this.toolbar.update();
    this.display.update();
    this.charts.setTime(playback.time);
    if (!leader) return;
    this.camera.update(leader.rig.orthographic, themeChoice());
    for (const { stage } of this.panes) stage?.update(playback.time, options);
    const hidden = this.field.root.hidden;
    this.field.update(this.present());
    if (this.field.root.hidden !== hidden) this.makeRoom();
    this.panes.forEach(({ stage }, pane) => {
      const colors = this.theme.curves;
      const own = this.picks.picks
        .map((pick, i) => ({ pick, color: colors[i % colors.length]! }))
        .filter(({ pick }) => pick.pane === pane);
      stage?.render(options, own);
    });
    const { size } = leader.bounds;
    this.picks.update((curve) => valueAt(curve, playback.time), this.theme.curves, size);
    this.describe();
  }

  /** Another field is shown: the curves at nodes are those of another quantity. */
  private followField(): void {
    const { item, perElement } = this.options.field;
    const shown = `${item} ${perElement}`;
    if (shown === this.itemShown) return;
    if (this.itemShown && this.picks.picks.length > 0) this.picks.refresh();
    this.itemShown = shown;
    this.dirty = false;
  }

  /** Range of the field in all views. */
  private present(): [number, number] {
    const all = this.panes.flatMap(({ stage }) => stage?.present ?? []).filter(Number.isFinite);
    return all.length ? [Math.min(...all), Math.max(...all)] : [NaN, NaN];
  }

  /** Texts in the corner, and what a screen reader says about the picture. */
  private describe(): void {
    const { options, leader, playback } = this;
    const { factor, unit } = prefixFor(leader!.gridSpacing, 'm');
    const grid = `grid ${figure(leader!.gridSpacing / factor, 1)} ${unit}`;
    const scale = options.scale === 1 ? '' : `deformation × ${figure(options.scale, 3)} · `;
    this.gridText.textContent = scale + grid;
    if (playback.playing) return;
    const field = options.colors ? this.field.itemShown?.label : '';
    const shown = field ? `, ${field} in colour` : '';
    this.panes.forEach(({ run, title, stage }) => {
      const time = `${figure(playback.time, 4)} ${run.clock}`;
      const text = `${title || run.title} at ${time}${shown}. Drag to turn, wheel to zoom, click to follow a node; ? lists the keys.`;
      if (stage && stage.canvas.ariaLabel !== text) stage.canvas.ariaLabel = text;
    });
    const said = field ?? '';
    if (this.status.textContent !== said) this.status.textContent = said;
  }

  private state(): ViewerState {
    // Draws first, so that a test never reads the picture before last.
    if (this.dirty) this.draw();
    const { time, playing, speed } = this.playback;
    const { leader } = this;
    const present = leader ? this.present() : [NaN, NaN];
    return {
      time,
      playing,
      speed,
      ...this.options,
      frame: leader?.motion.place.index ?? 0,
      orthographic: leader?.rig.orthographic ?? false,
      drawn: this.drawn,
      size: leader?.bounds.size ?? 0,
      cursors: this.charts.cursors(),
      mode: this.shapes[0]?.index ?? null,
      amplitude: this.shapes[0]?.amplitude ?? null,
      present: Number.isFinite(present[0]) ? (present as [number, number]) : null,
      cost: leader?.cost ?? { update: 0, render: 0 },
      picks: this.picks.picks.flatMap((pick) => {
        const { stage } = this.panes[pick.pane]!;
        if (!stage) return [];
        const body = this.runs[pick.pane]!.bodies[pick.body]!.name;
        const screen = stage.project(stage.placeOf(pick, this.options.scale));
        return { pane: pick.pane, body, node: pick.node, screen };
      }),
      cameras: this.panes.flatMap(({ stage }) => (stage ? [stage.rig.direction] : [])),
      bodies: (leader?.motion.bodies ?? []).map((motion) => ({
        name: motion.body.name,
        pose: [...motion.pose],
        screen: leader!.project(motion.toWorld([0, 0, 0])),
      })),
    };
  }
}
