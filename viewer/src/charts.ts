import { Chart, valueAt, type ChartContent, type Curve } from './chart';
import { el } from './dom';
import { TimeFormat } from './quantity';
import type { Run, Series } from './run';
import type { Theme } from './theme';

/** Plots share the column's height, within legible limits [CSS px]. */
const kLeastHeight = 112;
const kMostHeight = 220;

/** Names of the runs side by side. */
export const kRunNames = ['A', 'B'] as const;

/** Energies of one unit share a panel; every sensor has its own. */
export function chartSeries(run: Run): Series[] {
  const groups = new Map<string, Series[]>();
  for (const energy of run.energies) {
    groups.set(energy.unit, [...(groups.get(energy.unit) ?? []), energy]);
  }
  const frames = run.times.length;
  const energies = [...groups].map(([unit, members]) => {
    const k = members.length;
    const values = new Float32Array(frames * k);
    members.forEach(({ values: v }, c) => {
      for (let i = 0; i < frames; i++) values[i * k + c] = v[i]!;
    });
    const name = groups.size > 1 ? `Energies [${unit}]` : 'Energies';
    return { name, unit, components: members.map((m) => m.name), values };
  });
  return [...run.sensors, ...energies];
}

/** The panels of one run, or of two; quantities of the same name and unit share a panel. */
export function chartContents(runs: Run[]): ChartContent[] {
  const panels = new Map<string, ChartContent>();
  runs.forEach((run, r) => {
    for (const { name, unit, components, values } of chartSeries(run)) {
      const key = `${name}\n${unit}`;
      const panel = panels.get(key) ?? { name, unit, curves: [] };
      panels.set(key, panel);
      components.forEach((component, offset) => {
        const label = runs.length > 1 ? `${component} ${kRunNames[r]!}`.trim() : component;
        const curve = { label, times: run.times, values, stride: components.length, offset };
        panel.curves.push({ ...curve, color: offset, dashed: r > 0 } satisfies Curve);
      });
    }
  });
  return [...panels.values()];
}

/**
 * The curve of the second run minus that of the first, at the first one's times that both have; null
 * where they have none in common.
 */
function difference(one: Curve, other: Curve, label: string): Curve | null {
  const [from, to] = [other.times[0]!, other.times.at(-1)!];
  const times = one.times.filter((t) => t >= from && t <= to);
  if (times.length === 0) return null;
  const values = Float32Array.from(times, (t) => valueAt(other, t) - valueAt(one, t));
  return { ...one, label, times, values, stride: 1, offset: 0 };
}

/** The panels of two runs with what the second has more than the first. */
export function differenceContents(runs: Run[]): ChartContent[] {
  return chartContents(runs).map(({ name, unit, curves }) => {
    const [ones, others] = [curves.filter((c) => !c.dashed), curves.filter((c) => c.dashed)];
    const found = ones.map((one) => {
      const component = one.label.slice(0, -kRunNames[0].length);
      const other = others.find((c) => c.label === `${component}${kRunNames[1]}`);
      return other ? difference(one, other, `${component}B − A`) : null;
    });
    return { name, unit, curves: found.filter((curve) => curve !== null) };
  });
}

/** The column of curves beside the view. */
export class Charts {
  readonly root = el('div', { class: 'charts' });
  private charts: Chart[];
  private readonly shown = new Set<number>();
  private readonly format: TimeFormat;
  /** The curves at picked nodes; comes first. */
  private extra: Chart | null = null;
  private time = 0;
  /** Times shown; null: all. */
  private window: [number, number] | null = null;
  private readonly whole: [number, number];

  /** @param least threshold below which values of a unit are shown as zero */
  constructor(
    private readonly runs: Run[],
    times: Float64Array,
    private theme: Theme,
    private readonly seek: (t: number) => void,
    private readonly least: (unit: string) => number = () => 0,
  ) {
    const duration = (times.at(-1) ?? 0) - (times[0] ?? 0);
    this.format = new TimeFormat(duration, runs[0]?.clock ?? 's');
    this.whole = [times[0] ?? 0, times.at(-1) ?? 0];
    this.charts = chartContents(runs).map((content) => this.chart(content));
    // Sensors come first and energies last: show the first three of the former and the latter.
    const isEnergy = (chart: Chart) => chart.content.name.startsWith('Energies');
    let sensors = 0;
    this.charts.forEach((chart, i) => {
      if (isEnergy(chart) || sensors++ < 3) this.shown.add(i);
    });
  }

  private chart(content: ChartContent): Chart {
    const zoom = (factor: number, at: number) => this.zoom(factor, at);
    return new Chart(content, this.seek, this.least(content.unit), zoom);
  }

  /** Whether there are two runs to compare. */
  get canDiffer(): boolean {
    return this.runs.length === 2;
  }

  /** Shows the second run minus the first instead of both. */
  setDifference(on: boolean): void {
    for (const chart of this.charts) chart.destroy();
    const contents = on ? differenceContents(this.runs) : chartContents(this.runs);
    this.charts = contents.map((content) => this.chart(content));
    this.layOut();
  }

  /** Shows `factor` times as much of the time axes, `at` staying in place; infinity: all of it. */
  zoom(factor: number, at: number): void {
    const [first, last] = this.whole;
    const [from, to] = this.window ?? this.whole;
    const low = Math.max(first, at - factor * (at - from));
    const high = Math.min(last, at + factor * (to - at));
    // Single precision of the values does not tell more apart.
    if (high - low < 1e-6 * (last - first)) return;
    this.window = Number.isFinite(factor) && high - low < last - first ? [low, high] : null;
    this.layOut();
  }

  get names(): string[] {
    return this.charts.map((chart) => chart.content.name);
  }

  get timeUnit(): string {
    return this.format.unit;
  }

  isShown(index: number): boolean {
    return this.shown.has(index);
  }

  show(index: number, on: boolean): void {
    if (on) this.shown.add(index);
    else this.shown.delete(index);
    this.layOut();
  }

  /** Puts curves of its own before the panels of the run; null takes them away. */
  setExtra(content: ChartContent | null): void {
    this.extra?.destroy();
    this.extra = content ? this.chart(content) : null;
    this.layOut();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.layOut();
  }

  private get chosen(): Chart[] {
    const own = this.charts.filter((chart, i) => this.shown.has(i) && chart.content.curves.length > 0);
    return this.extra ? [this.extra, ...own] : own;
  }

  /** Draws the chosen panels at the current width. */
  layOut(): void {
    for (const chart of this.charts) chart.destroy();
    const { chosen } = this;
    this.root.replaceChildren(...chosen.map((chart) => chart.root));
    if (chosen.length === 0) {
      const none =
        this.charts.length === 0 ? 'This run recorded no sensors.' : 'No curve is chosen.';
      this.root.append(el('p', { class: 'nothing' }, none));
    }
    for (const chart of chosen) {
      chart.draw(this.theme, this.width, this.height, this.format, this.window);
    }
    this.setTime(this.time);
  }

  private get width(): number {
    return Math.max(160, this.root.clientWidth - 20);
  }

  /** Height of one plot: the column without the titles, in equal parts. */
  private get height(): number {
    const { chosen } = this;
    // 13 px of padding and line per panel, 14 px around all of them.
    const titles = chosen.reduce((sum, chart) => sum + chart.titleHeight + 13, 14);
    const share = Math.floor((this.root.clientHeight - titles) / Math.max(1, chosen.length));
    return Math.min(kMostHeight, Math.max(kLeastHeight, share));
  }

  resize(): void {
    const [width, height] = [this.width, this.height];
    for (const chart of this.chosen) chart.setSize(width, height);
    this.setTime(this.time);
  }

  setTime(t: number): void {
    this.time = t;
    for (const chart of this.chosen) chart.setTime(t);
  }

  /** Cursor position of each shown panel [CSS px], for tests. */
  cursors(): { name: string; x: number }[] {
    return this.chosen.map(({ content, cursor }) => ({
      name: content.name,
      x: Number(/translateX\(([-\d.]+)px\)/.exec(cursor.style.transform)?.[1] ?? NaN),
    }));
  }
}
