// Two runs in one page.
import assert from 'node:assert/strict';
import { difference, open, openRange, overflows, pixels, setTime, settle, state } from './browser_page.mjs';

export async function sideBySideSpecs({ test, browser, variant }) {
  const { tab, complaints } = await open(browser, variant('side-by-side'));

  await test('two runs share time, camera, scale and curves', async () => {
    assert.equal(await tab.locator('.pane canvas').count(), 2);
    assert.deepEqual(await tab.locator('.pane-title').allInnerTexts(), [
      'A: once',
      'B: twice · bending=2',
    ]);
    assert.match(await tab.locator('h1').innerText(), /^Flexible slider-crank – A: once \| B: twice/);
    const a = await pixels(tab);
    await setTime(tab, 0.07);
    assert.ok(difference(a, await pixels(tab)) > 200);
    // The second rod bends twice as much: the common scale ends at its stress.
    const top = Number(await tab.locator('.field-panel .ticks span').first().innerText());
    assert.ok(top > 900 && top < 1000, `the scale ends at ${top}`);
    const chart = tab.locator('.chart[data-name="mid deflection"]');
    const values = (await chart.locator('.legend b').allInnerTexts()).map((t) => Number(t.replace('−', '-')));
    assert.equal(values.length, 2);
    // B has fewer frames: linear between them to 1 %.
    assert.ok(Math.abs(values[1] / values[0] - 2) < 0.02, values.join(' '));
    assert.equal(await chart.locator('.swatch.dashed').count(), 1);
    const box = await tab.locator('.pane').nth(1).boundingBox();
    await tab.mouse.move(box.x + 150, box.y + 400);
    await tab.mouse.down();
    await tab.mouse.move(box.x + 210, box.y + 340, { steps: 4 });
    await tab.mouse.up();
    await settle(tab);
    const { cameras } = await state(tab);
    assert.ok(Math.hypot(...cameras[0].map((x, i) => x - cameras[1][i])) < 1e-6, 'cameras part');
    assert.ok(cameras[0][2] < 0.99, 'the camera has not turned');
    await tab.keyboard.press('o');
    await settle(tab);
    const after = (await state(tab)).cameras;
    assert.ok(Math.hypot(...after[0].map((x, i) => x - after[1][i])) < 1e-6);
    for (const width of [1100, 700]) {
      await tab.setViewportSize({ width, height: 800 });
      await settle(tab);
      assert.deepEqual(await overflows(tab), [], String(width));
      await openRange(tab);
      await settle(tab);
      assert.deepEqual(await overflows(tab), [], `${width}, range open`);
      await openRange(tab);
    }
    await tab.setViewportSize({ width: 1000, height: 640 });
  });

  await test('a node of the second run is told from the first', async () => {
    await setTime(tab, 0.01);
    await tab.getByLabel('Body of the node').selectOption({ label: 'rod B' });
    await tab.getByLabel('Number of the node').fill('6');
    await tab.getByRole('button', { name: 'Follow', exact: true }).click();
    await tab.getByLabel('Body of the node').selectOption({ label: 'rod A' });
    await tab.getByLabel('Number of the node').fill('6');
    await tab.getByRole('button', { name: 'Follow', exact: true }).click();
    const lines = await tab.locator('.picks li').allInnerTexts();
    assert.match(lines[0], /rod 6 B/);
    assert.match(lines[1], /rod 6 A/);
    assert.deepEqual((await state(tab)).picks.map(({ pane }) => pane), [1, 0]);
    assert.deepEqual(complaints, []);
    await tab.close();
  });
}
