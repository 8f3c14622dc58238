// Models of other kinds and sizes, vibrations, and pages that lack something.
import assert from 'node:assert/strict';
import { colors, difference, open, overflows, pixels, setTime, settle, state } from './browser_page.mjs';

export async function variantSpecs({ test, browser, variant }) {
  await test('planar models start parallel along the normal, spatial ones in perspective', async () => {
    const flat = await open(browser, variant('slider-crank'));
    assert.equal((await state(flat.tab)).orthographic, true);
    await flat.tab.close();
    const space = await open(browser, variant('slider-crank-3d'));
    assert.equal((await state(space.tab)).orthographic, false);
    assert.deepEqual(space.complaints, []);
    await space.tab.close();
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
