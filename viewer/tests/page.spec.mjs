// What a person sees, checked in headless Chromium.
//   node tests/page.spec.mjs [PAGE.html]     or BUCKENS_PAGE=PAGE.html; by default synthetic runs
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch } from '../scripts/chromium.mjs';
import { captureSpecs } from './capture_specs.mjs';
import { fieldSpecs } from './field_specs.mjs';
import { kVariants, pageWith } from './fixture.mjs';
import { pageSpecs } from './page_specs.mjs';
import { pickSpecs } from './pick_specs.mjs';
import { sideBySideSpecs } from './side_by_side_specs.mjs';
import { variantSpecs } from './variant_specs.mjs';

const kGiven = process.argv[2] ?? process.env.BUCKENS_PAGE;
/** Browsers at work at the same time, each with specs of its own. */
const kBrowsers = 2;
const folder = mkdtempSync(join(tmpdir(), 'buckens-page-'));
let failed = 0;

async function test(name, body) {
  const began = Date.now();
  try {
    await body();
    console.log(`ok    ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.error(
      `FAIL  ${name}\n      ${String(error.stack ?? error).replaceAll('\n', '\n      ')}`,
    );
  }
}

const written = new Map();
function variant(name) {
  if (!written.has(name)) {
    written.set(name, join(folder, `${name}.html`));
    writeFileSync(written.get(name), pageWith(kVariants[name]()));
  }
  return written.get(name);
}

const queue = kGiven
  ? [(tools) => pageSpecs({ ...tools, page: kGiven, synthetic: false })]
  : [
      fieldSpecs,
      captureSpecs,
      (tools) => pageSpecs({ ...tools, page: variant('slider-crank'), synthetic: true }),
      pickSpecs,
      variantSpecs,
      sideBySideSpecs,
    ];

async function work() {
  if (queue.length === 0) return;
  const browser = await launch();
  try {
    while (queue.length > 0) await queue.shift()({ test, browser, variant });
  } finally {
    await browser.close();
  }
}

try {
  await Promise.all(Array.from({ length: kBrowsers }, work));
} finally {
  rmSync(folder, { recursive: true });
}
if (failed) console.error(`${failed} failed`);
process.exit(failed ? 1 : 0);
