// Models of other kinds and sizes, vibrations, and pages that lack something.
import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';
import { colors, difference, open, overflows, pixels, setTime, settle, state } from './browser_page.mjs';

export async function variantSpecs({ test, browser, variant }) {
  await test('a model of 0.6 mm looks like one of 0.6 m, one far away too; planar ones start parallel', async () => {
    const shots = [];
    for (const [name, planar] of [
      ['slider-crank', true],
      ['tiny', true],
      ['far', false],
      ['slider-crank-3d', false],
    ]) {
      const opened = await open(browser, variant(name));
      await opened.tab.locator('.scrub').evaluate((input) => {
        input.value = 0.2;
        input.dispatchEvent(new Event('input'));
      });
      // Texts and grids may differ: compare where the bodies are on the screen.
      const { bodies, orthographic } = await state(opened.tab);
      shots.push(bodies.map(({ screen }) => screen));
      assert.equal(orthographic, planar, name);
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
    // Its only load acts on all bodies and has no arrows.
    assert.equal(await opened.tab.locator('[data-toggle="loads"]').count(), 0);
    await opened.tab.locator('.chips').click();
    const details = await opened.tab.locator('dialog[open]').innerText();
    assert.match(details, /step too large/);
    assert.ok(!/[a-z]_[a-z]/.test(details), 'a raw key in the details');
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

  await test('a spinning shaft and a spinning hub are seen to turn', async () => {
    const opened = await open(browser, variant('rotor'));
    await setTime(opened.tab, 0);
    const first = await pixels(opened.tab);
    // A quarter of a turn.
    await setTime(opened.tab, Math.PI / 12);
    const later = await pixels(opened.tab);
    // Either alone changes more than half of this.
    assert.ok(difference(first, later) > 1500, `${difference(first, later)} pixels changed`);
    assert.deepEqual(opened.complaints, []);
    await opened.tab.close();
  });

  await test('thousands of bodies are drawn and move; some are named, forces are shown', async () => {
    const opened = await open(browser, variant('crowd'));
    await setTime(opened.tab, 0);
    const first = await pixels(opened.tab);
    await setTime(opened.tab, 1);
    const later = await pixels(opened.tab);
    // From afar a line of some 500 pixels, which moves down by less than one, changes its colours.
    assert.ok(colors(first).size > 5, `${colors(first).size} colours`);
    const near = await opened.tab.evaluate(() => {
      const page = window.__buckens;
      const kept = page.keep();
      const { target } = kept.camera;
      page.adopt({ ...kept, camera: { ...kept.camera, orthographic: false, position: [target[0], target[1], target[2] + 0.002] } });
      const there = page.keep().camera;
      page.adopt(kept);
      return there.position[2] - there.target[2];
    });
    // A fifth of the closest look at what has no thousands of parts: some links fill the picture.
    assert.ok(Math.abs(near - 0.002) < 1e-6, `${near}`);
    const { bodies } = await state(opened.tab);
    assert.deepEqual(bodies[2999].pose.slice(0, 3), [2999, 2, 0]);
    await opened.tab.locator('[data-toggle="labels"]').click();
    await settle(opened.tab);
    const names = await opened.tab.locator('.label.body:visible').count();
    assert.ok(names > 20 && names <= 80, `${names} names`);
    await opened.tab.locator('[data-toggle="labels"]').click();
    await opened.tab.locator('[data-toggle="reactions"]').click();
    const pushed = await pixels(opened.tab);
    assert.ok(difference(later, pushed) > 100, `${difference(later, pushed)} pixels of forces`);
    await opened.tab.locator('.display summary').click();
    const trace = opened.tab.getByLabel('Trace of a point');
    await trace.focus();
    assert.equal(await trace.locator('option').count(), 1 + 3 * 3000);
    await opened.tab.getByRole('button', { name: 'Details' }).click();
    assert.match(await opened.tab.locator('dialog[open]').innerText(), /Rigid bodies\s+3000/);
    assert.deepEqual(opened.complaints, []);
    await opened.tab.close();
  });

  await test('vibrations: a mode and its amplitude are chosen, its shape swings', async () => {
    const opened = await open(browser, variant('modes'));
    const modes = opened.tab.locator('[data-mode]');
    assert.equal(await modes.count(), 3);
    assert.match(await modes.first().innerText(), /beam 1\s+53\.2 Hz/);
    assert.equal(await opened.tab.getByLabel('Deformation scale', { exact: true }).count(), 0);
    // Colours show the shape, relative to its largest displacement.
    assert.equal(await opened.tab.locator('.field-panel .item option:checked').innerText(), 'Relative displacement');
    assert.equal(await opened.tab.locator('.field-panel .unit').innerText(), '');
    assert.equal(await opened.tab.locator('.field-panel .ticks span').first().innerText(), '1.00');
    await opened.tab.locator('.chips').click();
    assert.match(await opened.tab.locator('dialog[open]').innerText(), /3 of 3 vibrations/);
    await opened.tab.keyboard.press('Escape');
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
    // A path is that of the mode shown, also if another one was shown when it was chosen.
    await modes.first().click();
    await opened.tab.locator('.display summary').click();
    await opened.tab.locator('.trace').selectOption({ label: 'beam (mass centre)' });
    await opened.tab.locator('.display summary').click();
    await modes.nth(1).click();
    const traced = await pixels(opened.tab);
    await opened.tab.locator('.display summary').click();
    await opened.tab.locator('.trace').selectOption('');
    await opened.tab.locator('.display summary').click();
    assert.ok(difference(traced, await pixels(opened.tab)) > 40, 'the path of the first mode');
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

  await test('vibrations side by side have one clock', async () => {
    const opened = await open(browser, variant('modes-side-by-side'));
    assert.match(await opened.tab.locator('[data-mode]').first().innerText(), /53\.2 Hz \| 26\.6 Hz/);
    assert.match(await opened.tab.locator('.clock').innerText(), / \/ 18\.80 ms/);
    await opened.tab.keyboard.press('ArrowDown');
    await settle(opened.tab);
    assert.match(await opened.tab.locator('.clock').innerText(), / \/ 0\.800\d* s/);
    assert.deepEqual(opened.complaints, []);
    await opened.tab.close();
  });

  await test('without WebGL the page says so and shows the curves', async () => {
    const tab = await browser.newPage({ viewport: { width: 1000, height: 640 }, reducedMotion: 'reduce' });
    await tab.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = (
        (usual) =>
        function (kind, ...rest) {
          return kind === '2d' ? usual.call(this, kind, ...rest) : null;
        }
      )(HTMLCanvasElement.prototype.getContext);
    });
    const faults = [];
    tab.on('pageerror', (error) => faults.push(String(error)));
    await tab.goto(pathToFileURL(variant('side-by-side')).href);
    assert.match(await tab.locator('.notice').innerText(), /needs WebGL, which this browser does not offer/);
    await setTime(tab, 0.05);
    const { cursors, cameras } = await state(tab);
    assert.ok(cursors.length >= 4 && cursors.every(({ x }) => x > 10), 'the curves do not follow');
    assert.deepEqual(cameras, []);
    await tab.getByLabel('Number of the node').fill('6');
    await tab.getByRole('button', { name: 'Follow', exact: true }).click();
    await tab.locator('h1').click();
    await tab.keyboard.press('l');
    await settle(tab);
    assert.deepEqual(faults, []);
    await tab.close();
  });

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
