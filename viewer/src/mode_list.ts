import { el } from './dom';
import { figure } from './quantity';
import type { ModeShapes } from './modes';

const kMostAmplitude = 0.3;

/** The column beside the view of a page with vibrations: which mode, and how far it swings. */
export class ModeList {
  readonly root: HTMLElement;
  private readonly entries: HTMLButtonElement[];
  private readonly amplitude: HTMLInputElement;

  /** `changed` is called after another mode or amplitude was chosen. */
  constructor(
    private readonly shapes: ModeShapes,
    private readonly changed: () => void,
  ) {
    this.entries = shapes.modes.map(({ label, frequency, mass }, i) =>
      el(
        'button',
        {
          type: 'button',
          'data-mode': String(i),
          title: `${label}: generalised mass ${figure(mass, 4)} kg at 1 m`,
          click: () => this.choose(i),
        },
        el('span', {}, label),
        el('b', {}, frequency > 0 ? `${Number(frequency.toPrecision(6))} Hz` : 'unstable'),
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
      'aside',
      { class: 'side modes', 'aria-label': 'Modes' },
      el('div', { class: 'side-head' }, el('h2', {}, 'Modes')),
      el(
        'label',
        { class: 'field', title: 'Largest displacement as a share of the model’s size' },
        'Amplitude',
        this.amplitude,
      ),
      el('div', { class: 'mode-list', role: 'group' }, ...this.entries),
    );
    this.mark();
  }

  choose(index: number): void {
    this.shapes.show(index, Number(this.amplitude.value));
    this.mark();
    this.changed();
  }

  /** To the mode `steps` further down the list. */
  step(steps: number): void {
    this.choose(this.shapes.index + steps);
    this.entries[this.shapes.index]?.scrollIntoView({ block: 'nearest' });
  }

  private mark(): void {
    this.entries.forEach((entry, i) =>
      entry.setAttribute('aria-pressed', String(i === this.shapes.index)),
    );
  }
}
