import { el } from './dom';

/** A list to choose one of several values. */
export function choice(
  name: string,
  values: readonly string[],
  chosen: string,
  change: (value: string) => void,
): HTMLSelectElement {
  const select = el('select', { 'aria-label': name });
  for (const value of values) select.append(el('option', { value }, value));
  select.value = chosen;
  select.addEventListener('change', () => change(select.value));
  return select;
}

/** A line with a word before its controls. */
export function entry(text: string, ...controls: (Node | string)[]): HTMLElement {
  return el('div', { class: 'entry' }, el('span', {}, text), ...controls);
}
