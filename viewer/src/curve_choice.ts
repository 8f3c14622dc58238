import { el } from './dom';
import type { Charts } from './charts';

/** Head of the curves' column: unit of the time axes, and a list to choose panels from. */
export function curveChoice(charts: Charts): HTMLElement {
  const head = el('div', { class: 'side-head' }, el('h2', {}, 'Curves'));
  if (charts.names.length === 0) return head;
  const boxes = charts.names.map((name, i) => {
    const box = el('input', {
      type: 'checkbox',
      checked: charts.isShown(i),
      change: () => charts.show(i, box.checked),
    });
    return el('label', {}, box, name);
  });
  const list = el(
    'details',
    { class: 'choice' },
    el('summary', {}, 'Choose'),
    el('div', {}, ...boxes),
  );
  document.addEventListener('pointerdown', (event) => {
    if (!list.contains(event.target as Node)) list.open = false;
  });
  if (charts.canDiffer) {
    const box = el('input', {
      type: 'checkbox',
      'data-difference': '',
      change: () => charts.setDifference(box.checked),
    });
    const title = 'What the second run has more than the first';
    head.append(el('label', { class: 'differ', title }, box, 'B − A'));
  }
  head.append(el('span', { class: 'unit' }, `${charts.timeUnit === 'steps' ? 'path' : 'time'} in ${charts.timeUnit}`), list);
  return head;
}
