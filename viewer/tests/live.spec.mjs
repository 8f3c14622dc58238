// `buckens view --live` beside a run that goes on, in headless Chromium.
//   node tests/live.spec.mjs PROGRAM MODEL
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch } from '../scripts/chromium.mjs';

const [program, model] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'buckens-live-'));
const out = join(folder, 'out');
const kLimit = 90e3; // a busy machine may take long [ms]

async function until(what, check) {
  const end = Date.now() + kLimit;
  for (;;) {
    const found = await check();
    if (found) return found;
    if (Date.now() > end) throw new Error(`no ${what}`);
    await new Promise((done) => setTimeout(done, 200));
  }
}

const run = spawn(program, ['run', model, '-o', out, '-q'], { stdio: 'ignore' });
let live, browser;
try {
  await until('results', () => existsSync(join(out, 'results.h5')));
  live = spawn(program, ['view', out, '--live'], { stdio: ['ignore', 'pipe', 'inherit'] });
  let said = '';
  live.stdout.on('data', (text) => (said += text));
  const address = await until('address', () => /http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//.exec(said)?.[0]);
  browser = await launch();
  const tab = await browser.newPage({ viewport: { width: 1000, height: 640 }, reducedMotion: 'reduce' });
  const complaints = [];
  tab.on('pageerror', (error) => complaints.push(String(error)));
  tab.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(data|blob|about):/.test(url)) complaints.push(`fetched ${url}`);
  });
  await tab.goto(address);
  const frame = async () => {
    const handle = await tab.$('iframe:not(.next)');
    return handle ? await handle.contentFrame() : null;
  };
  // One question at a time may meet a page that is being replaced.
  const ask = (question) => async () => {
    try {
      return await (await frame())?.evaluate(question);
    } catch {
      return null;
    }
  };
  const end = ask(() => {
    if (!window.__buckens) return null;
    window.__buckens.setTime(Number.MAX_VALUE);
    return window.__buckens.state().time;
  });
  const first = await until('page', end);
  assert.match(await tab.locator('#state').innerText(), /^Live: the run goes on$/);
  assert.equal(await tab.title(), 'Long run – Buckens');
  // What is chosen stays, and so does the end: the page follows.
  await until('toggle', ask(() => {
    const button = document.querySelector('[data-toggle="labels"]');
    if (button?.getAttribute('aria-pressed') === 'false') button.click();
    return button !== null;
  }));
  const shown = await tab.evaluate(() => Number(document.body.dataset.pages));
  await until('newer page', () => tab.evaluate((n) => Number(document.body.dataset.pages) > n + 1, shown));
  const state = await until('state', ask(() => window.__buckens?.state()));
  assert.ok(state.time > first, `the time is ${state.time}, was ${first}`);
  assert.equal(state.labels, true, 'the choice is lost');
  assert.equal(await tab.locator('iframe').count() <= 2, true);
  run.kill('SIGINT');
  await until('end', async () => (await tab.locator('#state').innerText()) === 'Live: the run was interrupted');
  live.kill('SIGINT');
  const code = await new Promise((done) => live.on('exit', done));
  assert.equal(code, 0);
  await until('notice', async () => /has ended/.test(await tab.locator('#state').innerText()));
  assert.deepEqual(complaints, []);
  console.log('ok    the page follows the run');
} finally {
  await browser?.close();
  live?.kill('SIGKILL');
  run.kill('SIGKILL');
  rmSync(folder, { recursive: true, force: true });
}
