// What holds for any page of a run, and what the slider-crank shows.
import assert from 'node:assert/strict';
import {
  colors,
  covered,
  difference,
  open,
  openRange,
  overflows,
  pixels,
  setTime,
  settle,
  state,
} from './browser_page.mjs';

/** @param page the page to look at; `synthetic`: it is that of the slider-crank */
export async function pageSpecs({ test, browser, page, synthetic }) {
  const { tab, complaints } = await open(browser, page);
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
    // The button itself changes about 1500 pixels: count below the toolbar.
    const below = (p) => ({ ...p, data: p.data.subarray(4 * p.width * 45) });
    const first = below(await pixels(tab));
    for (const button of await tab.locator('[data-toggle]').all()) {
      const name = await button.getAttribute('data-toggle');
      const before = (await state(tab))[name];
      await button.click();
      assert.equal((await state(tab))[name], !before, name);
      assert.equal(await button.getAttribute('aria-pressed'), String(!before));
      await tab.mouse.move(500, 632);
      // A ghost under an unmagnified deformation may hide in the body itself.
      const least = name === 'undeformed' ? 5 : 40;
      assert.ok(difference(first, below(await pixels(tab))) > least, `${name} shows nothing`);
      await button.click();
      assert.equal((await state(tab))[name], before, name);
    }
    await tab.mouse.move(500, 632);
    assert.equal(difference(first, below(await pixels(tab))), 0, 'something stays');
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
      [390, 844],
    ]) {
      await tab.setViewportSize({ width, height });
      await settle(tab);
      assert.deepEqual(await overflows(tab), [], `${width} × ${height}`);
      await tab.locator('[data-fit]').click();
      for (const fraction of [0, 0.2, 0.55]) {
        await setTime(tab, start + fraction * (end - start));
        assert.deepEqual(await covered(tab), [], `${width} × ${height}`);
      }
      if (!(await tab.locator('.field-panel').isVisible())) continue;
      await openRange(tab);
      await settle(tab);
      assert.deepEqual(await overflows(tab), [], `${width} × ${height}, range open`);
      await openRange(tab);
    }
    await tab.setViewportSize({ width: 1000, height: 640 });
  });

  await test('no errors, no warnings, no requests', async () => {
    assert.deepEqual(complaints, []);
  });

  if (synthetic) {
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
  }
  await tab.close();
}
