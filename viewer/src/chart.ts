import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { el } from './dom';
import { figure, prefixFor, type Prefix, type TimeFormat } from './quantity';
import { locate } from './interpolation';
import type { Theme } from './theme';

/** One line in a panel. */
export interface Curve {
  label: string;
  times: Float64Array;
  /** The curve's number of frame i is values[stride · i + offset]. */
  values: Float32Array;
  stride: number;
  offset: number;
  /** Index into the theme's colours. */
  color: number;
  dashed: boolean;
}

export interface ChartContent {
  name: string;
  unit: string;
  curves: Curve[];
}

/** Values smaller than `least` are rounding errors of zero. */
export function orZero(value: number, least: number): number {
  return Math.abs(value) < least ? 0 : value;
}

function valueOf({ values, stride, offset }: Curve, frame: number): number {
  return values[stride * frame + offset]!;
}

/** The curve's value at time t, linear between frames. */
export function valueAt(curve: Curve, t: number): number {
  const { index, fraction } = locate(curve.times, t);
  const now = valueOf(curve, index);
  return fraction === 0 ? now : now * (1 - fraction) + valueOf(curve, index + 1) * fraction;
}

/** All instants of the curves, each once, increasing. */
export function allTimes(curves: { times: Float64Array }[]): Float64Array {
  const lists = [...new Set(curves.map((curve) => curve.times))];
  if (lists.length === 1) return lists[0]!;
  const all = Float64Array.from(lists.flatMap((list) => [...list])).sort();
  return all.filter((t, i) => i === 0 || t > all[i - 1]!);
}

/**
 * The curve's numbers at the given instants in units of `factor`; undefined where it has none. Values
 * below `least` count as zero.
 */
export function aligned(
  curve: Curve,
  times: Float64Array,
  factor: number,
  least = 0,
): (number | null | undefined)[] {
  let frame = 0;
  return Array.from(times, (t) => {
    while (curve.times[frame]! < t) frame++;
    if (curve.times[frame] !== t) return undefined;
    const value = orZero(valueOf(curve, frame), least) / factor;
    return Number.isFinite(value) ? value : null;
  });
}

function largest(curves: Curve[]): number {
  let most = 0;
  for (const curve of curves) {
    for (let i = 0; i < curve.times.length; i++) {
      const size = Math.abs(valueOf(curve, i));
      if (size > most && size < Infinity) most = size;
    }
  }
  return most;
}

/** One panel: title, legend with the values at the current time, curves, time cursor. */
export class Chart {
  readonly root: HTMLElement;
  readonly cursor = el('div', { class: 'time-cursor' });
  private readonly values: HTMLElement[];
  private readonly host = el('div', { class: 'plot' });
  private readonly prefix: Prefix;
  private readonly reading = el('span', { class: 'reading' });
  private plot: uPlot | null = null;
  private time = 0;
  /** Time under the pointer; null without one. */
  private hovered: number | null = null;

  /** @param least values below it are drawn and written as zero */
  constructor(
    readonly content: ChartContent,
    private readonly seek: (t: number) => void,
    private readonly least = 0,
    private readonly zoom: (factor: number, at: number) => void = () => undefined,
  ) {
    const { name, curves } = content;
    this.prefix = prefixFor(orZero(largest(curves), least), content.unit);
    this.values = curves.map(() => el('b'));
    const unit = this.prefix.unit ? el('span', { class: 'unit' }, this.prefix.unit) : '';
    const legend = el('div', { class: 'legend' });
    curves.forEach(({ label, dashed }, c) => {
      const swatch = el('i', { class: dashed ? 'swatch dashed' : 'swatch', 'data-curve': c });
      legend.append(el('span', {}, swatch, label, ' ', this.values[c]!));
    });
    const head = el('div', { class: 'chart-head' }, el('h3', {}, name), unit, this.reading, legend);
    this.host.setAttribute('role', 'img');
    this.host.setAttribute('aria-label', `Curves of ${name} over time`);
    this.root = el('section', { class: 'chart', 'data-name': name }, head, this.host);
  }

  get titleHeight(): number {
    return (this.root.firstElementChild as HTMLElement).offsetHeight;
  }

  /** @param window times shown; null: all */
  draw(
    theme: Theme,
    width: number,
    height: number,
    format: TimeFormat,
    window: [number, number] | null = null,
  ): void {
    this.plot?.destroy();
    this.hovered = null;
    const { curves } = this.content;
    const times = allTimes(curves);
    const columns = curves.map((curve) => aligned(curve, times, this.prefix.factor, this.least));
    const color = (c: number) => theme.curves[curves[c]!.color % theme.curves.length]!;
    this.root.querySelectorAll<HTMLElement>('.swatch').forEach((swatch, c) => {
      swatch.style.setProperty('--curve', color(c));
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
        x: { time: false, range: () => window ?? timeRange(times) },
        y: { range: (_u, low, high) => airy(low, high) },
      },
      axes: [
        {
          ...axis,
          size: 24,
          gap: 2,
          values: (_u, ticks) => ticks.map((t) => trim(format.number(t))),
        },
        { ...axis, size: 54, gap: 4, space: 20, values: (_u, ticks) => tickTexts(ticks) },
      ],
      hooks: {
        ready: [() => this.setTime(this.time)], // only now are there scales
        setCursor: [(u) => this.hover(u, format)],
      },
      series: [
        {},
        ...curves.map(({ dashed, times: own }, c) => ({
          stroke: color(c),
          width: 1.6,
          dash: dashed ? [6, 4] : undefined,
          pxAlign: 0,
          points: { show: own.length < 2 },
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
    plot.over.addEventListener('wheel', (event) => {
      // Without a key the wheel moves the column.
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const way = event.deltaY || event.deltaX;
      const left = event.clientX - plot.over.getBoundingClientRect().left;
      this.zoom(2 ** (way / 300), plot.posToVal(left, 'x'));
    });
    plot.over.addEventListener('dblclick', () => this.zoom(Infinity, 0));
  }

  /** The legend tells the values under the pointer instead of the present ones. */
  private hover(plot: uPlot, format: TimeFormat): void {
    const { left } = plot.cursor;
    const t = left !== undefined && left >= 0 ? plot.posToVal(left, 'x') : null;
    if (t === this.hovered) return;
    this.hovered = t;
    this.root.classList.toggle('hovered', t !== null);
    this.reading.textContent = t === null ? '' : `at ${format.number(t)} ${format.unit}`;
    this.tell();
  }

  setSize(width: number, height: number): void {
    this.plot?.setSize({ width, height });
  }

  setTime(t: number): void {
    this.time = t;
    if (!this.plot) return;
    const x = this.plot.valToPos(t, 'x');
    if (Number.isFinite(x)) this.cursor.style.transform = `translateX(${x.toFixed(2)}px)`;
    this.cursor.hidden = x < -1 || x > this.plot.over.clientWidth + 1;
    this.tell();
  }

  private tell(): void {
    const t = this.hovered ?? this.time;
    this.content.curves.forEach((curve, c) => {
      this.values[c]!.textContent = figure(orZero(valueAt(curve, t), this.least) / this.prefix.factor);
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

/** A value range with margins above and below, never empty. */
function airy(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [-1, 1];
  // Float32 noise of a constant must not fill the panel.
  const least = 1e-5 * Math.max(Math.abs(low), Math.abs(high)) || 1;
  const span = Math.max(high - low, least);
  const middle = (low + high) / 2;
  return [middle - 0.58 * span, middle + 0.58 * span];
}

/** Without trailing zeros. */
function trim(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

/** Ticks with as many digits as needed to tell them apart. */
export function tickTexts(ticks: number[]): string[] {
  const apart = ticks.length > 1 ? Math.abs(ticks[1]! - ticks[0]!) : 0;
  const largest = Math.max(...ticks.map(Math.abs));
  const digits = apart > 0 ? Math.ceil(Math.log10(largest / apart)) + 1 : 4;
  return ticks.map((value) => tick(value, Math.min(8, Math.max(4, digits))));
}

function tick(value: number, digits: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text =
    size >= 1e5 || size < 1e-3
      ? value.toExponential(1)
      : String(Number(value.toPrecision(digits)));
  return text.replace('-', '−').replace('e+', 'e').replace('e-', 'e−');
}
