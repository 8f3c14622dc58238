// What the page tests need to know about an open page.
import { pathToFileURL } from 'node:url';
import { decodePng } from './png.mjs';

/** Opens a page and records whatever goes wrong in it or is fetched by it. */
export async function open(browser, path, options = {}) {
  const tab = await browser.newPage({
    viewport: { width: 1000, height: 640 },
    reducedMotion: 'reduce',
    ...options,
  });
  const complaints = [];
  tab.on('console', (message) => {
    // Software WebGL reports its own slowness; everything else counts.
    const driver = /GPU stall due to ReadPixels|SwiftShader/.test(message.text());
    if (['error', 'warning'].includes(message.type()) && !driver) complaints.push(message.text());
  });
  tab.on('pageerror', (error) => complaints.push(String(error)));
  tab.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) complaints.push(`fetched ${request.url()}`);
  });
  // A busy machine may take long; the test that waits has its own limit.
  await tab.goto(pathToFileURL(path).href, { timeout: 120000 });
  return { tab, complaints };
}

export const state = (tab) => tab.evaluate(() => window.__buckens.state());
export const settle = (tab) =>
  tab.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
export const setTime = async (tab, t) => {
  await tab.evaluate((time) => window.__buckens.setTime(time), t);
  await settle(tab);
};

const kSessions = new WeakMap();

/** RGBA pixels of the 3-D view from a screenshot: what a person sees. */
export async function pixels(tab) {
  await settle(tab);
  if (!kSessions.has(tab)) kSessions.set(tab, await tab.context().newCDPSession(tab));
  const clip = { ...(await tab.locator('.view').boundingBox()), scale: 1 };
  // Compressed little: the picture is unpacked at once.
  const shot = { format: 'png', optimizeForSpeed: true, clip };
  const { data } = await kSessions.get(tab).send('Page.captureScreenshot', shot);
  return decodePng(Buffer.from(data, 'base64'));
}

/** Pixels that differ by more than 24 of 255 in some channel. */
export function difference(a, b) {
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const far = [0, 1, 2].some((k) => Math.abs(a.data[i + k] - b.data[i + k]) > 24);
    if (far) count++;
  }
  return count;
}

/** Colours in the middle of the view, away from the buttons over it, rounded to 16 levels. */
export function colors({ data, width, height }) {
  const seen = new Map();
  for (let y = 100; y < height - 100; y++) {
    for (let x = 10; x < width - 110; x++) {
      const i = 4 * (y * width + x);
      const key = `${data[i] >> 4},${data[i + 1] >> 4},${data[i + 2] >> 4}`;
      seen.set(key, (seen.get(key) ?? 0) + 1);
    }
  }
  return seen;
}

/** What sticks out, is cut off, or covers something else that one has to read or press. */
export async function overflows(tab) {
  return tab.evaluate(() => {
    const { scrollWidth, scrollHeight } = document.documentElement;
    const found = scrollWidth > innerWidth || scrollHeight > innerHeight ? ['page'] : [];
    for (const part of document.querySelectorAll('.top, .transport, .toolbar, .side, .chart')) {
      const box = part.getBoundingClientRect();
      if (part.scrollWidth > part.clientWidth + 1) found.push(`${part.className} is clipped`);
      if (box.right > innerWidth + 1) found.push(`${part.className} sticks out`);
    }
    const over = [...document.querySelectorAll('.bars button, .bars summary, .field-panel')];
    const boxes = over.map((part) => part.getBoundingClientRect()).filter((box) => box.width > 0);
    boxes.forEach((a, i) => {
      for (const b of boxes.slice(i + 1)) {
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        const inside = b.left >= a.left && b.right <= a.right && b.top >= a.top && b.bottom <= a.bottom;
        if (wide > 1 && high > 1 && !inside) found.push('buttons over the view overlap');
      }
    });
    // What is open in the panel can be read and pressed in full.
    const panel = document.querySelector('.field-panel');
    const frame = panel?.querySelector('.settings')?.getBoundingClientRect();
    for (const part of panel?.querySelectorAll('details[open] .settings *') ?? []) {
      const box = part.getBoundingClientRect();
      if (box.width > 0 && (box.right > frame.right + 1 || box.left < frame.left - 1)) {
        found.push('the range is clipped');
      }
      if (box.right > innerWidth + 1 || box.left < -1) found.push('the range sticks out');
    }
    return [...new Set(found)];
  });
}

/** Bodies whose mass centre is hidden by controls over the view, or outside of it. */
export async function covered(tab) {
  const { bodies } = await state(tab);
  return tab.evaluate((all) => {
    const view = document.querySelector('.view').getBoundingClientRect();
    const over = [...document.querySelectorAll('.bars button, .bars summary, .field-panel')]
      .map((part) => part.getBoundingClientRect())
      .filter((box) => box.width > 0);
    return all
      .filter(({ screen: { x, y } }) => {
        const [u, v] = [x + view.left, y + view.top];
        const hidden = over.some((b) => u > b.left && u < b.right && v > b.top && v < b.bottom);
        return hidden || u < view.left || u > view.right || v < view.top || v > view.bottom;
      })
      .map(({ name }) => name);
  }, bodies);
}

/** Mean colour of a small square of the view about a place of it [CSS px]. */
export function colorAt({ data, width }, x, y, half = 2) {
  const sum = [0, 0, 0];
  let count = 0;
  for (let v = Math.round(y) - half; v <= Math.round(y) + half; v++) {
    for (let u = Math.round(x) - half; u <= Math.round(x) + half; u++) {
      for (let k = 0; k < 3; k++) sum[k] += data[4 * (v * width + u) + k];
      count++;
    }
  }
  return sum.map((x) => Math.round(x / count));
}

/** Opens the choices of the colour scale. */
export const openRange = (tab) => tab.locator('.field-panel summary').click();
