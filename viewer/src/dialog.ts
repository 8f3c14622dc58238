import { el } from './dom';

/** A modal box with a title; closed by its button, by Escape and by a click outside it. */
export function modal(title: string, ...content: (Node | string)[]): HTMLDialogElement {
  const dialog = el('dialog', { class: 'details', 'aria-label': title });
  const close = el('button', { class: 'icon', type: 'button', 'aria-label': 'Close' }, '✕');
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', (event) => event.target === dialog && dialog.close());
  dialog.append(el('header', {}, el('h2', {}, title), close), ...content);
  return dialog;
}

/** Two columns: names and values. */
export function nameTable(rows: [string, string][]): HTMLTableElement {
  const lines = rows.map(([name, text]) =>
    el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, text)),
  );
  return el('table', {}, ...lines);
}
