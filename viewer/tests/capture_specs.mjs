// Pictures and videos of the page, and curves looked at closely.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { open, setTime, settle, state } from './browser_page.mjs';
import { decodePng } from './png.mjs';

const numbers = async (locator) =>
  (await locator.allInnerTexts()).map((text) => Number(text.replace('−', '-')));

async function saved(tab, act) {
  const waiting = tab.waitForEvent('download', { timeout: 60000 });
  await act();
  const download = await waiting;
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

export async function captureSpecs({ test, browser, variant }) {
  const { tab, complaints } = await open(browser, variant('slider-crank'));

  await test('the picture that is saved shows the machine', async () => {
    await setTime(tab, 0.01);
    const { name, bytes } = await saved(tab, () => tab.locator('[data-picture]').click());
    assert.match(name, /^Flexible_slider_crank.*\.png$/);
    const { data, width, height } = decodePng(bytes);
    const box = await tab.locator('.pane canvas').boundingBox();
    assert.ok(Math.abs(width / height - box.width / box.height) < 0.01, `${width} x ${height}`);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(`${data[i] >> 4},${data[i + 1] >> 4},${data[i + 2] >> 4}`);
    assert.ok(seen.size > 12, `${seen.size} colours only`);
  });

  await test('a video of the whole run is saved, and plays', async () => {
    await tab.evaluate(() => {
      const speed = document.querySelector('[aria-label="Speed"]');
      speed.value = '0.6';
      speed.dispatchEvent(new Event('input'));
    });
    const { name, bytes } = await saved(tab, () => tab.keyboard.press('m'));
    assert.match(name, /\.webm$/);
    assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3, 'not a WebM file');
    const size = await tab.evaluate(async (base64) => {
      const video = document.createElement('video');
      const buffer = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      video.src = URL.createObjectURL(new Blob([buffer], { type: 'video/webm' }));
      await new Promise((done, fail) => {
        video.onloadeddata = done;
        video.onerror = () => fail(new Error('the video cannot be decoded'));
      });
      return [video.videoWidth, video.videoHeight];
    }, bytes.toString('base64'));
    const box = await tab.locator('.pane canvas').boundingBox();
    assert.ok(Math.abs(size[0] - box.width) <= 2 && Math.abs(size[1] - box.height) <= 2, String(size));
    const { playing, time } = await state(tab);
    assert.equal(playing, false);
    assert.ok(time > 0, 'the last picture stays');
    assert.equal(await tab.locator('[data-video]').getAttribute('aria-pressed'), 'false');
  });

  await test('the legend tells the values under the pointer', async () => {
    const chart = tab.locator('.chart').first();
    const legend = chart.locator('.legend b');
    await setTime(tab, 0);
    const present = await numbers(legend);
    const over = await chart.locator('.u-over').boundingBox();
    await tab.mouse.move(over.x + 0.31 * over.width, over.y + 20);
    await settle(tab);
    const hovered = await numbers(legend);
    const reading = /^at ([\d.]+) (m?s)$/.exec(await chart.locator('.reading').innerText());
    assert.ok(reading, 'no time is told');
    const t = Number(reading[1]) * (reading[2] === 'ms' ? 1e-3 : 1);
    assert.notDeepEqual(hovered, present);
    // They are those of that time.
    await tab.mouse.move(5, 5);
    await setTime(tab, t);
    const then = await numbers(legend);
    const scale = Math.max(...then.map(Math.abs), ...hovered.map(Math.abs));
    then.forEach((value, i) => assert.ok(Math.abs(value - hovered[i]) < 0.03 * scale, `${then} ${hovered}`));
    assert.equal(await chart.locator('.reading').innerText(), '');
  });

  await test('the wheel with shift zooms all curves, a double click shows all again', async () => {
    const chart = tab.locator('.chart').first();
    const cursor = async () => (await state(tab)).cursors.map(({ x }) => x);
    const end = await tab.evaluate(() => {
      window.__buckens.setTime(1e9);
      return window.__buckens.state().time;
    });
    await setTime(tab, 0.5 * end);
    const over = await chart.locator('.u-over').boundingBox();
    const before = await cursor();
    await tab.mouse.move(over.x + 0.25 * over.width, over.y + 20);
    await tab.keyboard.down('Shift');
    await tab.mouse.wheel(0, -300);
    await tab.keyboard.up('Shift');
    await settle(tab);
    // Half as much with the quarter in place: what was in the middle is now at three quarters of it.
    const expected = 0.25 * over.width + 2 * (before[0] - 0.25 * over.width);
    for (const x of await cursor()) {
      assert.ok(Math.abs(x - expected) < 0.02 * over.width, `${x}, expected ${expected}`);
    }
    await chart.locator('.u-over').dblclick({ position: { x: 0.5 * over.width, y: 20 } });
    await settle(tab);
    const whole = await cursor();
    assert.ok(Math.abs(whole[0] - 0.5 * over.width) < 0.02 * over.width, 'not all is shown');
  });

  await test('the difference of two runs', async () => {
    const pair = await open(browser, variant('side-by-side'));
    await setTime(pair.tab, 0.07);
    const legend = pair.tab.locator('.chart[data-name="mid deflection"] .legend b');
    const [a, b] = await numbers(legend);
    await pair.tab.locator('[data-difference]').check();
    const values = await numbers(legend);
    assert.equal(values.length, 1);
    assert.ok(Math.abs(values[0] - (b - a)) < 0.02 * Math.abs(b), `${values} is not ${b} - ${a}`);
    await pair.tab.locator('[data-difference]').uncheck();
    assert.deepEqual(await numbers(legend), [a, b]);
    assert.deepEqual(pair.complaints, []);
    await pair.tab.close();
  });

  await test('nothing was fetched or complained about', async () => {
    assert.deepEqual(complaints, []);
    await tab.close();
  });
}
