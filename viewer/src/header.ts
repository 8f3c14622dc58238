import { modal, nameTable } from './dialog';
import { el } from './dom';
import { flatten, notices, summaryChips, trustReasons } from './run_summary';
import type { Run } from './run';

function list(title: string, lines: string[]): HTMLElement[] {
  if (lines.length === 0) return [];
  return [
    el('h3', {}, title),
    el('ul', { class: 'warnings' }, ...lines.map((l) => el('li', {}, l))),
  ];
}

/** The dialog with warnings in full and every figure of the summary. */
function details(run: Run): HTMLDialogElement {
  const rows = flatten(run.summary);
  const made = [run.version && `Buckens ${run.version}`, run.generated].filter(Boolean).join(' · ');
  return modal(
    run.title,
    el('p', { class: 'made' }, made),
    ...list('Why the result needs a second look', trustReasons(run.summary)),
    ...list('Warnings', notices(run.summary)),
    el('h3', {}, 'Summary of the run'),
    rows.length ? nameTable(rows) : el('p', {}, 'The run left no summary.'),
  );
}

/** Title and the few figures that say how the run went; a click on them shows all. */
export function header(run: Run): HTMLElement {
  const dialog = details(run);
  const open = () => dialog.showModal();
  const chips = summaryChips(run).map(({ label, value, tone, title }) =>
    el('span', { class: `chip ${tone}`, title }, label ? `${label} ` : '', el('b', {}, value)),
  );
  return el(
    'header',
    { class: 'top' },
    el('span', { class: 'brand' }, 'Buckens'),
    el('h1', { title: run.title }, run.title),
    el(
      'button',
      { class: 'chips', title: 'All figures of the run', click: open },
      ...chips,
      'Details',
    ),
    dialog,
  );
}
