import { cssGradient, kColorMaps } from './color_map';
import { el } from './dom';
import { choice, entry } from './controls';
import { figure, prefixFor, type Prefix } from './quantity';
import type { FieldItem } from './fields';
import type { FieldShading } from './field_material';
import type { FieldChoice, ViewOptions } from './view_options';

const kMapNames = { spectrum: 'Spectrum', viridis: 'Viridis', diverging: 'Blue – red' };
/** Ticks of the scale from the top. */
const kTicks = [1, 0.75, 0.5, 0.25, 0];

/** The field that is shown in colour: which one, its scale, range and limits. */
export class FieldPanel {
  readonly root: HTMLElement;
  private readonly bar: HTMLElement;
  private readonly needle = el('i', { class: 'needle' });
  private readonly ticks = kTicks.map(() => el('span'));
  private readonly unit = el('span', { class: 'unit' });
  private readonly now = el('b');
  private readonly item: HTMLSelectElement;
  private readonly range: HTMLSelectElement;
  private readonly low: HTMLInputElement;
  private readonly high: HTMLInputElement;
  private readonly cutLow: HTMLInputElement;
  private readonly cutHigh: HTMLInputElement;
  private prefix: Prefix = { factor: 1, unit: '' };
  /** Range of the item over the run, by id. */
  private readonly known = new Map<string, [number, number]>();

  /**
   * @param rangeOf least and largest value of an item over all runs; may be slow
   */
  constructor(
    private readonly items: FieldItem[],
    private readonly options: ViewOptions,
    private readonly shading: FieldShading,
    private readonly rangeOf: (id: string) => [number, number],
    private readonly changed: () => void,
  ) {
    const { field } = options;
    this.item = this.itemChoice();
    this.range = choice('Range of the colours', ['run', 'frame', 'fixed'], field.range, (value) =>
      this.setRange(value as FieldChoice['range']),
    );
    [this.range.options[0]!.text, this.range.options[1]!.text] = ['whole run', 'this picture'];
    this.low = this.number('Lower end of the colours', (value) => this.fix(value ?? 0, field.high));
    this.high = this.number('Upper end of the colours', (value) => this.fix(field.low, value ?? 0));
    this.cutLow = this.number('Lower limit', (value) => (field.cutLow = value));
    this.cutHigh = this.number('Upper limit', (value) => (field.cutHigh = value));
    this.cutLow.placeholder = this.cutHigh.placeholder = 'none';
    this.bar = el('div', { class: 'bar' }, this.needle);
    this.root = el(
      'aside',
      { class: 'field-panel', 'aria-label': 'Field shown in colour' },
      this.item,
      el('div', { class: 'scale' }, this.bar, el('div', { class: 'ticks' }, ...this.ticks), this.unit),
      el('div', { class: 'now' }, 'now ', this.now),
      el(
        'details',
        {},
        el('summary', {}, 'Range and colours'),
        el('div', { class: 'settings' }, ...this.settings()),
      ),
    );
    this.choose(field.item);
  }

  private itemChoice(): HTMLSelectElement {
    const select = el('select', { class: 'item', 'aria-label': 'Field' });
    const groups = new Map<string, HTMLOptGroupElement>();
    for (const { id, group, label } of this.items) {
      let list = groups.get(group);
      if (!list) groups.set(group, (list = el('optgroup', { label: group })));
      list.append(el('option', { value: id }, label));
    }
    select.append(...groups.values());
    select.addEventListener('change', () => this.choose(select.value));
    return select;
  }

  private settings(): HTMLElement[] {
    const { field } = this.options;
    const cut = choice('Values beyond the limits', ['none', 'grey', 'hide'], field.cut, (value) => {
      field.cut = value as FieldChoice['cut'];
      this.changed();
    });
    cut.options[0]!.text = 'show';
    const map = choice('Colour scale', kColorMaps, field.map, (value) => {
      field.map = value as FieldChoice['map'];
      this.changed();
    });
    kColorMaps.forEach((name, i) => (map.options[i]!.text = kMapNames[name]));
    const bands = choice('Number of colours', ['0', '6', '10', '16'], String(field.bands), (value) => {
      field.bands = Number(value);
      this.changed();
    });
    bands.options[0]!.text = 'smooth';
    const flat = el('input', { type: 'checkbox', 'data-option': 'per-element', checked: field.perElement });
    flat.addEventListener('change', () => {
      field.perElement = flat.checked;
      this.changed();
    });
    return [
      entry('Range', this.range),
      entry('from', this.low, 'to', this.high),
      entry('Beyond', cut),
      entry('below', this.cutLow, 'above', this.cutHigh),
      entry('Scale', map),
      entry('Steps', bands),
      el('label', { class: 'entry' }, flat, 'one colour per element'),
    ];
  }

  /** An input field for a number in the unit of the scale; null when it is empty. */
  private number(name: string, set: (value: number | null) => void): HTMLInputElement {
    const input = el('input', { type: 'number', step: 'any', 'aria-label': name });
    input.addEventListener('change', () => {
      const value = Number(input.value);
      set(input.value === '' || !Number.isFinite(value) ? null : value * this.prefix.factor);
      this.changed();
    });
    return input;
  }

  private fix(low: number, high: number): void {
    const { field } = this.options;
    [field.low, field.high] = [low, high];
    field.range = 'fixed';
    this.range.value = 'fixed';
  }

  private setRange(range: FieldChoice['range']): void {
    const { field } = this.options;
    field.range = range;
    if (range === 'run') [field.low, field.high] = this.wholeRun();
    this.changed();
  }

  /** The next or the previous item of the list. */
  step(steps: number): void {
    const at = this.items.findIndex(({ id }) => id === this.options.field.item);
    const next = this.items[(at + steps + this.items.length) % this.items.length];
    if (next) this.choose(next.id);
  }

  /** The run has changed: ranges are computed again. */
  forget(): void {
    this.known.clear();
    const { field } = this.options;
    const range = this.wholeRun();
    if (field.range === 'run') [field.low, field.high] = range;
    this.choosePrefix(range);
  }

  private choosePrefix([low, high]: [number, number]): void {
    const unit = this.itemShown?.unit ?? '';
    this.prefix = prefixFor(Math.max(Math.abs(low), Math.abs(high)), unit === '1' ? '' : unit);
  }

  get itemShown(): FieldItem | undefined {
    return this.items.find(({ id }) => id === this.options.field.item);
  }

  /** Range over the whole run; from zero where nothing is negative. */
  private wholeRun(): [number, number] {
    const { item } = this.options.field;
    let range = this.known.get(item);
    if (!range) this.known.set(item, (range = this.rangeOf(item)));
    return [Math.min(0, range[0]), range[1]];
  }

  choose(id: string): void {
    const { field } = this.options;
    field.item = id;
    this.item.value = id;
    const [low, high] = this.wholeRun();
    [field.low, field.high] = [low, high];
    // Limits and fixed ranges belong to the quantity for which they were entered.
    [field.cutLow, field.cutHigh] = [null, null];
    if (field.range === 'fixed') field.range = 'run';
    this.range.value = field.range;
    this.choosePrefix([low, high]);
    this.changed();
  }

  /** Shows the choice and passes it to the graphics card, for pictures with values from … to. */
  update([from, to]: [number, number]): void {
    const { field, colors } = this.options;
    this.root.hidden = !colors || this.items.length === 0;
    if (this.root.hidden) return;
    if (field.range === 'frame' && Number.isFinite(from)) [field.low, field.high] = [from, to];
    this.shade();
    const { factor, unit } = this.prefix;
    this.bar.style.setProperty('--scale', cssGradient(field.map, field.bands));
    const span = field.high - field.low;
    this.ticks.forEach((tick, i) => {
      tick.textContent = figure((field.low + kTicks[i]! * span) / factor, 3);
    });
    this.unit.textContent = unit;
    // Values negligible on the scale are shown as zero.
    const least = 1e-4 * Math.max(Math.abs(field.low), Math.abs(field.high));
    const shown = (value: number) => figure(Math.abs(value) < least ? 0 : value / factor, 3);
    this.now.textContent = Number.isFinite(from) ? `${shown(from)} … ${shown(to)}` : '–';
    const at = span > 0 ? (to - field.low) / span : 0;
    this.needle.hidden = !(at >= 0 && at <= 1);
    this.needle.style.setProperty('--at', `${100 * at}%`);
    this.put(this.low, field.low);
    this.put(this.high, field.high);
    this.put(this.cutLow, field.cutLow);
    this.put(this.cutHigh, field.cutHigh);
  }

  private put(input: HTMLInputElement, value: number | null): void {
    if (document.activeElement === input) return;
    const text = value === null ? '' : String(Number((value / this.prefix.factor).toPrecision(5)));
    if (input.value !== text) input.value = text;
  }

  private shade(): void {
    const { field } = this.options;
    const { uniforms } = this.shading;
    this.shading.setMap(field.map);
    uniforms.fieldLow.value = field.low;
    // If there is only one value, all of it has the lowest colour.
    uniforms.fieldHigh.value = field.high > field.low ? field.high : field.low + 3e37;
    uniforms.fieldBands.value = field.bands;
    uniforms.cutMode.value = { none: 0, grey: 1, hide: 2 }[field.cut];
    uniforms.cutLow.value = field.cutLow ?? -3e38;
    uniforms.cutHigh.value = field.cutHigh ?? 3e38;
  }
}
