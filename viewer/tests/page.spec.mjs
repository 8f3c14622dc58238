// What a person sees, checked in headless Chromium.
//   node tests/page.spec.mjs [PAGE.html]     or BUCKENS_PAGE=PAGE.html; by default synthetic runs
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch } from '../scripts/chromium.mjs';
import {
  colors,
  difference,
  open,
  overflows,
  pixels,
  setTime,
  settle,
  state,
} from './browser_page.mjs';
import { fieldSpecs } from './field_specs.mjs';
import { kVariants, pageWith } from './fixture.mjs';
import { pickSpecs } from './pick_specs.mjs';
import { sideBySideSpecs } from './side_by_side_specs.mjs';

const kGiven = process.argv[2] ?? process.env.BUCKENS_PAGE;
const browser = await launch();
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

function variant(name) {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, pageWith(kVariants[name]()));
  return path;
}

const page = kGiven ?? variant('slider-crank');
const { tab, complaints } = await open(browser, page);
const first = await state(tab);
const end = await tab.evaluate(() => {
  window.__buckens.setTime(Number.MAX_VALUE);
  return window.__buckens.state().time;
});
const start = await tab.evaluate(() => {
  window.__buckens.setTime(-Number.MAX_VALUE);
  return window.__buckens.state().time;
});

await test('the canvas shows a model', async () => {
  await setTime(tab, start + 0.3 * (end - start));
  const seen = colors(await pixels(tab));
  const total = [...seen.values()].reduce((a, b) => a + b, 0);
  const most = Math.max(...seen.values());
  assert.ok(seen.size >= 8, `${seen.size} colours only`);
  assert.ok(total - most > 500, `${total - most} pixels differ from the background`);
});

await test('the slider moves the pose and the picture', async () => {
  const scrub = tab.locator('.scrub');
  const move = (value) =>
    scrub.evaluate((input, fraction) => {
      input.value = fraction;
      input.dispatchEvent(new Event('input'));
    }, value);
  await move(0.1);
  const [poseA, a] = [await state(tab), await pixels(tab)];
  await move(0.37);
  const [poseB, b] = [await state(tab), await pixels(tab)];
  assert.ok(Math.abs(poseB.time - (start + 0.37 * (end - start))) < 1e-3 * (end - start));
  const moved = poseB.bodies.map(({ pose }, i) =>
    Math.max(...pose.map((x, k) => Math.abs(x - poseA.bodies[i].pose[k]))),
  );
  assert.ok(Math.max(...moved) > 1e-4 * poseA.size, 'no body moved');
  assert.ok(difference(a, b) > 100, 'the picture did not change');
});

await test('the curve cursor follows the time, and a click in a curve sets it', async () => {
  const over = tab.locator('.u-over').first();
  if ((await over.count()) === 0) return;
  const box = await over.boundingBox();
  for (const fraction of [0.25, 0.8]) {
    await setTime(tab, start + fraction * (end - start));
    for (const { name, x } of (await state(tab)).cursors) {
      assert.ok(
        Math.abs(x - fraction * box.width) < 1.5,
        `${name}: cursor at ${x} of ${box.width}`,
      );
    }
  }
  await tab.mouse.click(box.x + 0.5 * box.width, box.y + 20);
  const clicked = (await state(tab)).time;
  assert.ok(Math.abs(clicked - (start + 0.5 * (end - start))) < 0.01 * (end - start));
  await tab.mouse.move(box.x + 0.5 * box.width, box.y + 20);
  await tab.mouse.down();
  await tab.mouse.move(box.x + 0.9 * box.width, box.y + 20, { steps: 4 });
  await tab.mouse.up();
  const dragged = (await state(tab)).time;
  assert.ok(Math.abs(dragged - (start + 0.9 * (end - start))) < 0.01 * (end - start));
});

await test('every toggle changes the picture and comes back', async () => {
  await setTime(tab, start + 0.13 * (end - start));
  for (const button of await tab.locator('[data-toggle]').all()) {
    const name = await button.getAttribute('data-toggle');
    // A ghost under an unmagnified deformation may hide in the body itself.
    const before = (await state(tab))[name];
    const a = await pixels(tab);
    await button.click();
    assert.equal((await state(tab))[name], !before, name);
    assert.equal(await button.getAttribute('aria-pressed'), String(!before));
    await tab.mouse.move(500, 632);
    const b = await pixels(tab);
    // The button itself changes about 1500 pixels: count below the toolbar.
    const below = (p) => ({ ...p, data: p.data.subarray(4 * p.width * 45) });
    const least = name === 'undeformed' ? 5 : 40;
    assert.ok(difference(below(a), below(b)) > least, `${name} shows nothing`);
    await button.click();
    assert.equal((await state(tab))[name], before, name);
  }
});

await test('space plays and pauses, arrows step, the clock shows the time', async () => {
  await setTime(tab, start);
  await tab.locator('.view canvas').focus();
  await tab.keyboard.press('ArrowRight');
  assert.equal((await state(tab)).frame, 1);
  await tab.keyboard.press('Space');
  await tab.waitForFunction((t) => window.__buckens.state().time > t, (await state(tab)).time);
  assert.equal((await state(tab)).playing, true);
  await tab.keyboard.press('Space');
  const paused = await state(tab);
  assert.equal(paused.playing, false);
  await settle(tab);
  assert.equal((await state(tab)).time, paused.time);
  await tab.keyboard.press('End');
  assert.equal((await state(tab)).time, end);
  assert.match(await tab.locator('.clock').innerText(), /\d.* \/ .*\d (s|ms|µs|ns)$/);
});

await test('the camera turns, zooms, fits and changes projection', async () => {
  const home = await pixels(tab);
  const box = await tab.locator('.view').boundingBox();
  await tab.mouse.move(box.x + 300, box.y + 400);
  await tab.mouse.down();
  await tab.mouse.move(box.x + 420, box.y + 340, { steps: 4 });
  await tab.mouse.up();
  await tab.mouse.wheel(0, -300);
  assert.ok(difference(home, await pixels(tab)) > 200, 'dragging turned nothing');
  await tab.locator('[data-fit]').click();
  await tab.mouse.move(500, 632);
  await tab.locator('.view canvas').focus();
  const flat = (await state(tab)).orthographic;
  await tab.keyboard.press('o');
  assert.equal((await state(tab)).orthographic, !flat);
  await tab.keyboard.press('o');
});

await test('nothing overflows or overlaps, from wide to narrow', async () => {
  for (const [width, height] of [
    [1280, 800],
    [1100, 700],
    [800, 900],
    [420, 800],
  ]) {
    await tab.setViewportSize({ width, height });
    await settle(tab);
    assert.deepEqual(await overflows(tab), [], `${width} × ${height}`);
  }
  await tab.setViewportSize({ width: 1000, height: 640 });
});

await test('no errors, no warnings, no requests', async () => {
  assert.deepEqual(complaints, []);
});

if (!kGiven) await syntheticOnly();

async function syntheticOnly() {
  await test('planar models start parallel along the normal, spatial ones in perspective', async () => {
    assert.equal(first.orthographic, true);
    const space = await open(browser, variant('slider-crank-3d'));
    assert.equal((await state(space.tab)).orthographic, false);
    assert.deepEqual(space.complaints, []);
    await space.tab.close();
  });

  await test('the deformation scale magnifies the rod', async () => {
    await setTime(tab, 0.0131);
    const a = await pixels(tab);
    await tab.locator('.field input[type=number]').fill('10');
    await tab.keyboard.press('Enter');
    assert.equal((await state(tab)).scale, 10);
    assert.ok(difference(a, await pixels(tab)) > 400);
    await tab.locator('.field input[type=number]').fill('1000');
    await tab.keyboard.press('Enter');
    assert.equal((await state(tab)).scale, 1000);
    await tab.locator('[data-auto-scale]').click();
    assert.equal((await state(tab)).scale, 1);
  });

  await test('a trace is drawn and curves can be chosen', async () => {
    await setTime(tab, 0.05);
    const a = await pixels(tab);
    await tab.locator('.display summary').click();
    await tab.locator('.trace').selectOption({ label: 'crank/pin' });
    await tab.locator('.display summary').click();
    assert.ok(difference(a, await pixels(tab)) > 200);
    const before = (await state(tab)).cursors.length;
    await tab.locator('.choice summary').click();
    await tab.locator('.choice label', { hasText: 'pin force' }).click();
    assert.equal((await state(tab)).cursors.length, before + 1);
  });

  await test('a model of 0.6 mm looks like one of 0.6 m, one far away too', async () => {
    const shots = [];
    for (const name of ['slider-crank', 'tiny', 'far', 'slider-crank-3d']) {
      const opened = await open(browser, variant(name));
      await opened.tab.locator('.scrub').evaluate((input) => {
        input.value = 0.2;
        input.dispatchEvent(new Event('input'));
      });
      // Texts and grids may differ: compare where the bodies are on the screen.
      shots.push((await state(opened.tab)).bodies.map(({ screen }) => screen));
      assert.deepEqual(opened.complaints, []);
      await opened.tab.close();
    }
    const apart = (a, b) => Math.max(...a.map((p, i) => Math.hypot(p.x - b[i].x, p.y - b[i].y)));
    assert.ok(apart(shots[0], shots[1]) < 0.1);
    // Float32 poses 2000 m away are good for 0.1 mm, about a fifth of a pixel here.
    assert.ok(apart(shots[3], shots[2]) < 1);
  });

  await test('a hostile title stays text, warnings are shown, dark works', async () => {
    const opened = await open(browser, variant('spatial'), { colorScheme: 'dark' });
    assert.equal(
      await opened.tab.locator('h1').innerText(),
      'Pendulum and spinning body </script> "&',
    );
    assert.equal(await opened.tab.locator('.chip.warn').count(), 2);
    await opened.tab.locator('.chips').click();
    assert.match(await opened.tab.locator('dialog[open]').innerText(), /step too large/);
    await opened.tab.keyboard.press('Escape');
    assert.ok(colors(await pixels(opened.tab)).size >= 8);
    await opened.tab.emulateMedia({ colorScheme: 'light' });
    await settle(opened.tab);
    const light = colors(await pixels(opened.tab));
    assert.ok(
      [...light.keys()].some((key) => key === '15,15,15'),
      'no light background',
    );
    assert.deepEqual(opened.complaints, []);
    await opened.tab.close();
  });

  await test('vibrations: a mode and its amplitude are chosen, its shape swings', async () => {
    const opened = await open(browser, variant('modes'));
    const modes = opened.tab.locator('[data-mode]');
    assert.equal(await modes.count(), 3);
    assert.match(await modes.first().innerText(), /beam 1\s+53\.2 Hz/);
    assert.equal(await opened.tab.getByLabel('Deformation scale', { exact: true }).count(), 0);
    await setTime(opened.tab, 0);
    const still = await pixels(opened.tab);
    await setTime(opened.tab, 0.25 / 53.2);
    const bent = await pixels(opened.tab);
    assert.ok(difference(still, bent) > 100, 'the first mode does not bend the beam');
    await modes.nth(1).click();
    assert.equal((await state(opened.tab)).mode, 1);
    await setTime(opened.tab, 0);
    const before = (await state(opened.tab)).bodies[0].pose;
    await setTime(opened.tab, 0.25 / 1.25);
    const after = await state(opened.tab);
    assert.ok(after.bodies[0].pose[1] - before[1] > 0.05 * after.size, 'the frame stays');
    await opened.tab.getByLabel('Amplitude').evaluate((input) => {
      input.value = 0;
      input.dispatchEvent(new Event('input'));
    });
    assert.equal((await state(opened.tab)).amplitude, 0);
    assert.deepEqual((await state(opened.tab)).bodies[0].pose, before);
    await opened.tab.keyboard.press('ArrowDown');
    assert.match(await opened.tab.locator('[aria-pressed=true][data-mode]').innerText(), /unstable/);
    assert.deepEqual(await overflows(opened.tab), []);
    assert.deepEqual(opened.complaints, []);
    await opened.tab.close();
  });

  const tools = { test, browser, variant };
  await fieldSpecs(tools);
  await pickSpecs(tools);
  await sideBySideSpecs(tools);

  const messages = {
    'one-frame': /One stored frame only/,
    'two-frames': /^$/,
    'no-frames': /no frame yet/,
    'no-bodies': /no bodies/,
    'no-curves': /^$/,
    empty: /No run in this page/,
    broken: /time\.f32: 2 numbers found, 7 expected/,
  };
  for (const [name, message] of Object.entries(messages)) {
    await test(`variant ${name} says what it lacks`, async () => {
      const opened = await open(browser, variant(name));
      await settle(opened.tab);
      const texts = await opened.tab.locator('.notice, .refusal').allInnerTexts();
      assert.match(texts.join(' '), message);
      assert.deepEqual(await overflows(opened.tab), []);
      assert.deepEqual(opened.complaints, []);
      await opened.tab.close();
    });
  }
}

await browser.close();
rmSync(folder, { recursive: true });
if (failed) console.error(`${failed} failed`);
process.exit(failed ? 1 : 0);
