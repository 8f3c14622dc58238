import './style/base.css';
import './style/view.css';
import './style/transport.css';
import './style/curves.css';
import './style/dialog.css';
import './style/modes.css';
import './style/narrow.css';
import { el } from './dom';
import { checkModes, ModeShapes } from './modes';
import { decodeRun, PageDataError } from './run';
import { Page } from './page';
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
    const run = decodeRun(data);
    document.title = `${run.title} – Buckens`;
    if (run.times.length === 0) {
      const text = 'The run stored no frame yet. Write the page again once the run is on its way.';
      app.append(refuse(run.title, text));
    } else {
      new Page(app, run, data.modes ? new ModeShapes(run, checkModes(data.modes, run)) : null);
    }
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

start(document.getElementById('app')!);
