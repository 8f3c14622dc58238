import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { el } from './dom';
import { figure, prefixFor, TimeFormat, type Prefix } from './quantity';
import { interpolateRow, locate } from './interpolation';
import type { Run, Series } from './run';
import type { Theme } from './theme';

/** Plots share the column's height, within what is legible [CSS px]. */
const kLeastHeight = 112;
const kMostHeight = 220;

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

function largest(values: Float32Array): number {
  let most = 0;
  for (const value of values) {
    const size = Math.abs(value);
    if (size > most && size < Infinity) most = size;
  }
  return most;
}

/** One panel: title, legend with the values at the present time, curves, time cursor. */
class Chart {
  readonly root: HTMLElement;
  readonly cursor = el('div', { class: 'time-cursor' });
  private readonly values: HTMLElement[];
  private readonly host = el('div', { class: 'plot' });
  private readonly prefix: Prefix;
  private readonly row: number[] = [];
  private plot: uPlot | null = null;

  constructor(
    readonly series: Series,
    private readonly run: Run,
    private readonly seek: (t: number) => void,
  ) {
    this.prefix = prefixFor(largest(series.values), series.unit);
    this.values = series.components.map(() => el('b'));
    const unit = this.prefix.unit ? el('span', { class: 'unit' }, this.prefix.unit) : '';
    const legend = el('div', { class: 'legend' });
    series.components.forEach((component, c) => {
      const swatch = el('i', { class: 'swatch', 'data-curve': c });
      legend.append(el('span', {}, swatch, component, ' ', this.values[c]!));
    });
    const head = el('div', { class: 'chart-head' }, el('h3', {}, series.name), unit, legend);
    this.root = el('section', { class: 'chart', 'data-name': series.name }, head, this.host);
  }

  get titleHeight(): number {
    return (this.root.firstElementChild as HTMLElement).offsetHeight;
  }

  draw(theme: Theme, width: number, height: number, format: TimeFormat): void {
    this.plot?.destroy();
    const { times } = this.run;
    const { components, values } = this.series;
    const k = components.length;
    const columns = components.map((_, c) =>
      Array.from(times, (_t, i) => {
        const value = values[i * k + c]! / this.prefix.factor;
        return Number.isFinite(value) ? value : null;
      }),
    );
    this.root.querySelectorAll<HTMLElement>('.swatch').forEach((swatch, c) => {
      swatch.style.background = theme.curves[c % theme.curves.length]!;
    });
    const axis = {
      stroke: theme.muted,
      font: '11px system-ui, sans-serif',
      grid: { stroke: theme.dark ? '#ffffff14' : '#0000000f', width: 1 },
      ticks: { show: false },
    };
    const options: uPlot.Options = {
      width,
      height,
      legend: { show: false },
      padding: [8, 12, 0, 0],
      cursor: {
        drag: { x: false, y: false },
        points: { show: false },
        y: false,
        sync: { key: 'time' },
      },
      scales: {
        x: { time: false, range: timeRange(times) },
        y: { range: (_u, low, high) => airy(low, high) },
      },
      axes: [
        {
          ...axis,
          size: 24,
          gap: 2,
          values: (_u, ticks) => ticks.map((t) => trim(format.number(t))),
        },
        { ...axis, size: 54, gap: 4, space: 26, values: (_u, ticks) => ticks.map(tick) },
      ],
      series: [
        {},
        ...components.map((_, c) => ({
          stroke: theme.curves[c % theme.curves.length]!,
          width: 1.6,
          pxAlign: 0,
          points: { show: times.length < 2 },
        })),
      ],
    };
    this.plot = new uPlot(options, [Array.from(times), ...columns] as uPlot.AlignedData, this.host);
    this.plot.over.append(this.cursor);
    this.listen(this.plot);
  }

  private listen(plot: uPlot): void {
    const time = (event: PointerEvent) =>
      plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, 'x');
    plot.over.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      plot.over.setPointerCapture(event.pointerId);
      this.seek(time(event));
    });
    plot.over.addEventListener('pointermove', (event) => {
      if (plot.over.hasPointerCapture(event.pointerId)) this.seek(time(event));
    });
  }

  setSize(width: number, height: number): void {
    this.plot?.setSize({ width, height });
  }

  setTime(t: number): void {
    if (!this.plot) return;
    const x = this.plot.valToPos(t, 'x');
    if (Number.isFinite(x)) this.cursor.style.transform = `translateX(${x.toFixed(2)}px)`;
    const k = this.values.length;
    interpolateRow(this.series.values, k, locate(this.run.times, t), this.row);
    this.values.forEach((out, c) => {
      out.textContent = figure(this.row[c]! / this.prefix.factor);
    });
  }

  destroy(): void {
    this.plot?.destroy();
    this.plot = null;
  }
}

/** The whole run, or something around its only time. */
function timeRange(times: Float64Array): [number, number] {
  const [first, last] = [times[0]!, times[times.length - 1]!];
  return last > first ? [first, last] : [first - 0.5, first + 0.5];
}

/** A value range with air above and below, never empty. */
function airy(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [-1, 1];
  // Float32 noise on a constant must not fill the panel.
  const least = 1e-5 * Math.max(Math.abs(low), Math.abs(high)) || 1;
  const span = Math.max(high - low, least);
  const middle = (low + high) / 2;
  return [middle - 0.58 * span, middle + 0.58 * span];
}

/** Without the zeros that only hold places. */
function trim(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

function tick(value: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text =
    size >= 1e5 || size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(4)));
  return text.replace('-', '−').replace('e+', 'e').replace('e-', 'e−');
}

/** The column of curves beside the view. */
export class Charts {
  readonly root = el('div', { class: 'charts' });
  private readonly charts: Chart[];
  private readonly shown = new Set<number>();
  private readonly format: TimeFormat;
  private time = 0;

  constructor(
    run: Run,
    private theme: Theme,
    seek: (t: number) => void,
  ) {
    this.format = new TimeFormat((run.times.at(-1) ?? 0) - (run.times[0] ?? 0));
    this.charts = chartSeries(run).map((series) => new Chart(series, run, seek));
    // Sensors come first and energies last: show the first three of the former and the latter.
    const sensors = Math.min(3, run.sensors.length);
    for (let i = 0; i < sensors; i++) this.shown.add(i);
    for (let i = run.sensors.length; i < this.charts.length; i++) this.shown.add(i);
  }

  get names(): string[] {
    return this.charts.map((chart) => chart.series.name);
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

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.layOut();
  }

  /** Draws the chosen panels at the present width. */
  layOut(): void {
    for (const chart of this.charts) chart.destroy();
    const chosen = this.charts.filter((_, i) => this.shown.has(i));
    this.root.replaceChildren(...chosen.map((chart) => chart.root));
    if (chosen.length === 0) {
      const none =
        this.charts.length === 0 ? 'This run recorded no sensors.' : 'No curve is chosen.';
      this.root.append(el('p', { class: 'nothing' }, none));
    }
    for (const chart of chosen) {
      chart.draw(this.theme, this.width, this.height, this.format);
    }
    this.setTime(this.time);
  }

  private get width(): number {
    return Math.max(160, this.root.clientWidth - 20);
  }

  /** Of one plot: what the titles leave of the column, in equal parts. */
  private get height(): number {
    const chosen = this.charts.filter((_, i) => this.shown.has(i));
    // 13 px of padding and line per panel, 14 px around all of them.
    const titles = chosen.reduce((sum, chart) => sum + chart.titleHeight + 13, 14);
    const share = Math.floor((this.root.clientHeight - titles) / Math.max(1, chosen.length));
    return Math.min(kMostHeight, Math.max(kLeastHeight, share));
  }

  resize(): void {
    const [width, height] = [this.width, this.height];
    this.charts.forEach((chart, i) => this.shown.has(i) && chart.setSize(width, height));
    this.setTime(this.time);
  }

  setTime(t: number): void {
    this.time = t;
    this.charts.forEach((chart, i) => this.shown.has(i) && chart.setTime(t));
  }

  /** Cursor place of each shown panel [CSS px], for tests. */
  cursors(): { name: string; x: number }[] {
    return this.charts
      .filter((_, i) => this.shown.has(i))
      .map(({ series, cursor }) => ({
        name: series.name,
        x: Number(/translateX\(([-\d.]+)px\)/.exec(cursor.style.transform)?.[1] ?? NaN),
      }));
  }
}
