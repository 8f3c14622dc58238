import { cssGradient } from './color_map';
import { el } from './dom';
import { figure, prefixFor } from './quantity';

/** Colour scale of the stresses with the largest value at the present time. */
export class StressLegend {
  readonly root: HTMLElement;
  private readonly now = el('b');
  private readonly needle = el('i', { class: 'needle' });

  /** @param ofSolids whether all stresses are those of solids */
  constructor(
    private readonly range: number,
    ofSolids: boolean,
  ) {
    const { factor, unit } = prefixFor(range, 'Pa');
    const bar = el('div', { class: 'bar' }, this.needle);
    bar.style.background = cssGradient();
    const ticks = [1, 0.75, 0.5, 0.25, 0].map((f) =>
      el('span', {}, figure((f * range) / factor, 3)),
    );
    this.root = el(
      'aside',
      { class: 'stress-legend', title: 'Largest |stress| of beams and bars, von Mises stress of solids' },
      el('div', {}, `${ofSolids ? 'von Mises' : '|σ|'} in ${unit}`),
      el('div', { class: 'scale' }, bar, el('div', { class: 'ticks' }, ...ticks)),
      el('div', {}, 'now ', this.now),
    );
  }

  update(visible: boolean, largest: number): void {
    this.root.hidden = !visible;
    if (!visible) return;
    const { factor } = prefixFor(this.range, 'Pa');
    this.now.textContent = figure(largest / factor, 3);
    this.needle.style.bottom = `${(100 * largest) / this.range}%`;
  }
}
