import { el } from './dom';
import { figure } from './quantity';
import type { ModeShapes } from './modes';

const kMostAmplitude = 0.3;

function hertz(frequency = NaN): string {
  if (Number.isNaN(frequency)) return '–';
  return frequency > 0 ? `${Number(frequency.toPrecision(6))} Hz` : 'unstable';
}

/** The column beside the view of a page with vibrations: mode and amplitude. */
export class ModeList {
  readonly root: HTMLElement;
  private readonly shapes: ModeShapes;
  private readonly entries: HTMLButtonElement[];
  private readonly amplitude: HTMLInputElement;
  private readonly share = el('output');

  /** Modes of one model, or of two side by side; `changed` is called after another mode or amplitude was chosen. */
  constructor(
    private readonly all: ModeShapes[],
    private readonly changed: () => void,
  ) {
    const shapes = all[0]!;
    this.shapes = shapes;
    this.entries = shapes.modes.map(({ label, mass }, i) =>
      el(
        'button',
        {
          type: 'button',
          'data-mode': String(i),
          title: `${label}: generalised mass ${figure(mass, 4)} kg at 1 m`,
          click: () => this.choose(i),
        },
        el('span', {}, label),
        el('b', {}, all.map((each) => hertz(each.modes[i]?.frequency)).join(' | ')),
      ),
    );
    this.amplitude = el('input', {
      type: 'range',
      min: 0,
      max: kMostAmplitude,
      step: 0.002,
      value: shapes.amplitude,
      'aria-label': 'Amplitude',
    });
    this.amplitude.addEventListener('input', () => this.choose(this.shapes.index));
    this.root = el(
      'div',
      { class: 'mode-choice' },
      el('div', { class: 'side-head' }, el('h2', {}, 'Modes')),
      el(
        'label',
        { class: 'field', title: 'Largest displacement as a share of the model’s size' },
        'Amplitude',
        this.amplitude,
        this.share,
      ),
      el('p', { class: 'mode-note' }, 'Shapes have no size of their own: colours show displacements over the largest one.'),
      el('div', { class: 'mode-list', role: 'group', 'aria-label': 'Modes' }, ...this.entries),
    );
    this.mark();
  }

  choose(index: number): void {
    for (const shapes of this.all) shapes.show(index, Number(this.amplitude.value));
    this.mark();
    this.changed();
  }

  /** To the mode `steps` further down the list. */
  step(steps: number): void {
    this.choose(this.shapes.index + steps);
    this.entries[this.shapes.index]?.scrollIntoView({ block: 'nearest' });
  }

  private mark(): void {
    const percent = `${Number((100 * this.shapes.amplitude).toFixed(1))} %`;
    const share = `${percent} of the model’s size`;
    this.share.textContent = percent;
    this.amplitude.setAttribute('aria-valuetext', share);
    this.entries.forEach((entry, i) =>
      entry.setAttribute('aria-pressed', String(i === this.shapes.index)),
    );
  }
}
