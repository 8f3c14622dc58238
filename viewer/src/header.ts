import { kRunNames } from './charts';
import { modal, nameTable } from './dialog';
import { el } from './dom';
import { errorTable } from './error_table';
import { namesOfRuns, titleOf } from './run_names';
import { notices, summaryChips, trustReasons } from './run_summary';
import { summaryGroups } from './summary_table';
import type { Run } from './run';

function list(title: string, lines: string[]): HTMLElement[] {
  if (lines.length === 0) return [];
  return [
    el('h3', {}, title),
    el('ul', { class: 'warnings' }, ...lines.map((l) => el('li', {}, l))),
  ];
}

function storageText({ storage }: Run): string {
  const what = storage.vibrations ? 'vibrations' : 'records';
  const shown = `${storage.shown} of ${storage.records} ${what} are in this page`;
  const rounded = storage.rounded ? ', deformations and fields rounded to 16 bits' : '';
  return `${[`${shown}${rounded}`, ...storage.notes].join('. ')}.`;
}

/** Directory of the run and the overrides used for it. */
function origin({ directory, changes }: Run): string[] {
  const set = changes.map((change) => `Set: ${change}`);
  return directory ? [`Directory: ${directory}`, ...set] : set;
}

/** Sensors with their uncertainties, of runs with an error statement. */
function errors({ summary }: Run): HTMLElement[] {
  const table = errorTable(summary);
  if (!table) return [];
  const head = ['Sensor', 'Largest', 'At the end', 'Uncertainty of the largest from'];
  const line = (tag: 'th' | 'td', cells: string[]) =>
    el('tr', {}, ...cells.map((cell) => el(tag, {}, cell)));
  const rows = table.rows.map(({ name, peak, final, split }) =>
    line('td', [name, peak, final, split]),
  );
  return [
    el('h3', {}, 'Sensors with their uncertainty'),
    el('table', { class: 'errors' }, line('th', head), ...rows),
    ...table.notes.map((note) => el('p', { class: 'made' }, note)),
  ];
}

/** Warnings in full and every figure of the summary. */
function details(run: Run): HTMLElement[] {
  const groups = summaryGroups(run.summary);
  const made = [run.version && `Buckens ${run.version}`, run.generated].filter(Boolean).join(' · ');
  return [
    el('p', { class: 'made' }, made),
    ...origin(run).map((line) => el('p', { class: 'made' }, line)),
    el('p', { class: 'made' }, storageText(run)),
    ...list('Why the result needs a second look', trustReasons(run.summary)),
    ...list('Warnings', notices(run.summary)),
    ...errors(run),
    ...groups.flatMap(({ title, rows }) => [el('h3', {}, title), nameTable(rows)]),
    ...(groups.length ? [] : [el('p', {}, 'The run left no summary.')]),
  ];
}

/** With little room only what shows whether the run can be trusted. */
function chips(run: Run, brief: boolean): HTMLElement[] {
  const shown = summaryChips(run).filter(({ tone }) => !brief || tone !== 'plain');
  return shown.map(({ label, value, tone, title }) =>
    el('span', { class: `chip ${tone}`, title }, label ? `${label} ` : '', el('b', {}, value)),
  );
}

/** Title and the most important figures of the run; a click on them shows all. */
export function header(runs: Run[]): HTMLElement {
  const names = namesOfRuns(runs);
  const title = titleOf(runs);
  const content =
    runs.length === 1
      ? details(runs[0]!)
      : runs.flatMap((run, i) => [el('h3', { class: 'run-name' }, names[i]!), ...details(run)]);
  const dialog = modal(title, ...content);
  const open = () => dialog.showModal();
  const buttons = runs.map((run, i) =>
    el(
      'button',
      { class: 'chips', type: 'button', title: storageText(run), click: open },
      ...(runs.length === 1 ? [] : [el('b', {}, kRunNames[i]!)]),
      ...chips(run, runs.length > 1),
      ...(i === runs.length - 1 ? [el('span', { class: 'more' }, 'Details')] : []),
    ),
  );
  return el(
    'header',
    { class: 'top' },
    el('span', { class: 'brand' }, 'Buckens'),
    el('h1', { title }, title),
    ...buttons,
    dialog,
  );
}
