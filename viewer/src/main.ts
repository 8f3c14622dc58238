import './style/base.css';
import './style/view.css';
import './style/transport.css';
import './style/curves.css';
import './style/dialog.css';
import './style/modes.css';
import './style/panels.css';
import './style/strip.css';
import './style/narrow.css';
import { el } from './dom';
import { checkModes, ModeShapes } from './modes';
import { checkPage, decodeRun, PageDataError } from './run';
import { Page } from './page';
import { titleOf } from './run_names';
import { startTheme } from './theme';
import type { PageData } from './page_data';

declare global {
  interface Window {
    BUCKENS_DATA?: PageData | null;
  }
}

function refuse(title: string, text: string): HTMLElement {
  return el(
    'main',
    { class: 'refusal' },
    el('span', { class: 'brand' }, 'Buckens'),
    el('h1', {}, title),
    el('p', {}, text),
  );
}

function start(app: HTMLElement): void {
  const data = window.BUCKENS_DATA;
  if (!data) {
    app.append(refuse('No run in this page', 'Write a page with a run in it: buckens view OUT'));
    return;
  }
  try {
    const pages = checkPage(data);
    const runs = pages.map(decodeRun);
    document.title = `${titleOf(runs)} – Buckens`;
    const empty = runs.find((run) => run.times.length === 0);
    if (empty) {
      const text = 'The run stored no frame yet. Write the page again once the run is on its way.';
      app.append(refuse(empty.title, text));
      return;
    }
    const vibrating = pages.filter((page) => page.modes);
    if (vibrating.length > 0 && vibrating.length < pages.length) {
      throw new PageDataError('a run and vibrations cannot be shown side by side');
    }
    const shapes: ModeShapes[] = [];
    vibrating.forEach((page, i) => {
      const modes = checkModes(page.modes!, runs[i]!);
      shapes.push(new ModeShapes(runs[i]!, modes, shapes[0] ?? null));
    });
    new Page(app, runs, shapes);
  } catch (error) {
    if (!(error instanceof PageDataError)) throw error;
    app.append(
      refuse(
        'This run cannot be shown',
        `${error.message}. Write the page again: buckens view OUT`,
      ),
    );
  }
}

startTheme();
start(document.getElementById('app')!);
