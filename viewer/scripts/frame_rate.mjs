// How fluid a page with many triangles is:  node scripts/frame_rate.mjs [TRIANGLES] [--frames N]
//   [--tensor] [--page PAGE.html] [--seconds S]
// Without graphics hardware the browser paints on the processor: pictures per second then say little
// about a desk computer. The time to work out shapes and colours is told apart from that.
import { mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { pageWith } from '../tests/fixture.mjs';
import { largeTorus } from '../tests/large_fixture.mjs';
import { launch } from './chromium.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    frames: { type: 'string', default: '20' },
    seconds: { type: 'string', default: '6' },
    tensor: { type: 'boolean', default: false },
    page: { type: 'string' },
  },
});
const triangles = Number(positionals[0] ?? 200000);
const folder = mkdtempSync(join(tmpdir(), 'buckens-rate-'));
const path = values.page ?? join(folder, 'ring.html');
if (!values.page) {
  const across = Math.round(Math.sqrt(triangles / 8));
  const around = Math.round(triangles / 2 / across);
  const { frames, tensor } = values;
  writeFileSync(path, pageWith(largeTorus({ around, across, frames: Number(frames), tensor })));
}

const quantile = (list, share) => list.sort((a, b) => a - b)[Math.floor(share * (list.length - 1))];
const browser = await launch();
try {
  const tab = await browser.newPage({
    viewport: { width: 1280, height: 800 },
    reducedMotion: 'reduce',
  });
  const began = Date.now();
  await tab.goto(pathToFileURL(path).href);
  await tab.evaluate(() => window.__buckens.state().drawn);
  const opened = Date.now() - began;
  const seen = await tab.evaluate(async (seconds) => {
    const paint = document.createElement('canvas').getContext('webgl2');
    const name = paint.getExtension('WEBGL_debug_renderer_info');
    const renderer = paint.getParameter(name ? name.UNMASKED_RENDERER_WEBGL : paint.RENDERER);
    document.querySelector('.play').click();
    const [update, render] = [[], []];
    const first = window.__buckens.state().drawn;
    const start = performance.now();
    while (performance.now() - start < 1000 * seconds) {
      await new Promise((done) => requestAnimationFrame(done));
      const { cost } = window.__buckens.state();
      update.push(cost.update);
      render.push(cost.render);
    }
    // The last picture may have taken long: what really passed counts.
    const passed = (performance.now() - start) / 1000;
    const pictures = window.__buckens.state().drawn - first;
    const heap = performance.memory?.usedJSHeapSize ?? 0;
    return { renderer, update, render, rate: pictures / passed, heap };
  }, Number(values.seconds));
  const size = (statSync(path).size / 2 ** 20).toFixed(1);
  const line = (list) =>
    `median ${quantile(list, 0.5).toFixed(1)} ms, 95 % below ${quantile(list, 0.95).toFixed(1)} ms`;
  console.log(`${triangles} triangles, page ${size} MiB, opened in ${(opened / 1000).toFixed(1)} s`);
  console.log(`shapes and colours on the processor: ${line(seen.update)}`);
  console.log(`handing over to ${seen.renderer}: ${line(seen.render)}`);
  console.log(`${seen.rate.toFixed(1)} pictures per second, heap ${(seen.heap / 2 ** 20).toFixed(0)} MiB`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
