import { choice, entry } from './controls';
import { el } from './dom';
import { figure, prefixFor } from './quantity';
import type { EdgeChoice } from './skin';
import type { Run } from './run';
import type { Section } from './section';
import type { SectionChoice, TracePoint, ViewOptions } from './view_options';

const kEdges: EdgeChoice[] = ['auto', 'none', 'outline', 'mesh', 'wireframe'];
const kAxes: SectionChoice['axis'][] = ['off', 'x', 'y', 'z'];

/** Points among which one is chosen, from which on the list is made when it is needed. */
const kManyPoints = 1000;

/** How bodies are drawn: edges, a section, the trace of a point. Opens over the view. */
export class DisplayPanel {
  readonly root: HTMLDetailsElement;
  private readonly edges: HTMLSelectElement;
  private readonly axis: HTMLSelectElement;
  private readonly slider: HTMLInputElement;
  private readonly place = el('output');
  private readonly cut: HTMLElement[];

  constructor(
    run: Run,
    private readonly options: ViewOptions,
    private readonly section: Section,
    private readonly changed: () => void,
  ) {
    const { section: cut } = options;
    this.edges = choice('Edges of elements', kEdges, options.edges, (value) => {
      options.edges = value as EdgeChoice;
      changed();
    });
    this.edges.options[0]!.text = 'by size';
    this.edges.options[3]!.text = 'all';
    this.axis = choice('Section across', kAxes, cut.axis, (value) => this.setAxis(value));
    const solid = run.bodies.filter(({ nodes }) => nodes.length > 0).map(({ name }) => name);
    const of = choice('Section through', ['', ...solid], '', (value) => {
      cut.body = value;
      changed();
    });
    of.options[0]!.text = 'everything';
    this.slider = el('input', { type: 'range', min: 0, max: 1, step: 0.005, 'aria-label': 'Section at' });
    this.slider.addEventListener('input', () => {
      cut.fraction = Number(this.slider.value);
      changed();
    });
    const flip = el('input', { type: 'checkbox', 'data-option': 'flip' });
    flip.addEventListener('change', () => {
      cut.flip = flip.checked;
      changed();
    });
    this.cut = [
      entry('through', of),
      entry('at', this.slider, this.place),
      el('label', { class: 'entry' }, flip, 'keep the other side'),
    ];
    const hasSkin = run.bodies.some((body) => body.faces || body.elements.length > 0);
    this.root = el(
      'details',
      { class: 'display' },
      el('summary', { title: 'Edges, section, trace' }, 'Display'),
      el(
        'div',
        { class: 'popover' },
        ...(hasSkin ? [entry('Edges', this.edges), entry('Section', this.axis), ...this.cut] : []),
        entry('Trace', this.traceChoice(run)),
      ),
    );
    document.addEventListener('pointerdown', (event) => {
      const outside = event.target instanceof Node && !this.root.contains(event.target);
      if (outside && !(event.target instanceof HTMLCanvasElement)) this.root.open = false;
    });
    this.root.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && this.close()) this.root.querySelector('summary')!.focus();
    });
    this.update();
  }

  private setAxis(value: string): void {
    const { section } = this.options;
    section.axis = value as SectionChoice['axis'];
    this.changed();
  }

  /** False if it was closed already. */
  close(): boolean {
    const { open } = this.root;
    this.root.open = false;
    return open;
  }

  /** No section, across x, y, z. */
  nextAxis(): void {
    const { section } = this.options;
    this.setAxis(kAxes[(kAxes.indexOf(section.axis) + 1) % kAxes.length]!);
  }

  nextEdges(): void {
    const { options } = this;
    options.edges = kEdges[(kEdges.indexOf(options.edges) + 1) % kEdges.length]!;
    this.changed();
  }

  private traceChoice(run: Run): HTMLElement {
    const select = el('select', {
      class: 'trace',
      'aria-label': 'Trace of a point',
      title: 'Path of a point',
    });
    select.append(el('option', { value: '' }, 'none'));
    const points: TracePoint[] = run.bodies.flatMap(({ name, markers }) =>
      [...markers.map((marker) => marker.name), ''].map((marker) => ({ body: name, marker })),
    );
    const fill = () => {
      select.append(
        ...points.map(({ body, marker }, value) =>
          el('option', { value }, marker ? `${body}/${marker}` : `${body} (mass centre)`),
        ),
      );
    };
    let isFilled = false;
    const fillOnce = () => {
      if (!isFilled) fill();
      isFilled = true;
    };
    // Tens of thousands of entries take a while: they are made once somebody looks for them.
    if (points.length <= kManyPoints) fill();
    else for (const event of ['pointerenter', 'focus']) select.addEventListener(event, fillOnce);
    select.addEventListener('change', () => {
      this.options.trace = select.value === '' ? null : points[Number(select.value)]!;
      this.changed();
    });
    return select;
  }

  update(): void {
    const { options, section } = this;
    this.edges.value = options.edges;
    this.axis.value = options.section.axis;
    const off = options.section.axis === 'off';
    for (const part of this.cut) part.hidden = off;
    if (off) return;
    this.slider.value = String(options.section.fraction);
    const { factor, unit } = prefixFor(section.bounds.size, 'm');
    const place = `${figure(section.coordinate(options.section) / factor, 3)} ${unit}`;
    this.place.textContent = place;
    this.slider.setAttribute('aria-valuetext', place);
  }
}
