// Picture of a page:  node scripts/screenshot.mjs PAGE.html OUT.png [--time FRACTION] [--width W]
//   [--height H] [--dark] [--click SELECTOR]... [--select "LABEL=TEXT"]... [--press KEY]...
//   [--follow NUMBER]... [--scale X]
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { launch } from './chromium.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    time: { type: 'string', default: '0.3' },
    width: { type: 'string', default: '1280' },
    height: { type: 'string', default: '800' },
    dark: { type: 'boolean', default: false },
    click: { type: 'string', multiple: true, default: [] },
    select: { type: 'string', multiple: true, default: [] },
    press: { type: 'string', multiple: true, default: [] },
    follow: { type: 'string', multiple: true, default: [] },
    scale: { type: 'string' },
  },
});
const [page, out] = positionals;
if (!page || !out) {
  console.error(
    'usage: screenshot.mjs PAGE.html OUT.png [--time FRACTION] [--width W] [--height H]' +
      ' [--dark] [--click SELECTOR] [--select "LABEL=TEXT"] [--press KEY] [--follow NUMBER]' +
      ' [--scale X]',
  );
  process.exit(2);
}

const kPatience = 300e3; // a busy machine without graphics hardware draws slowly [ms]

const browser = await launch();
try {
  const tab = await browser.newPage({
    viewport: { width: Number(values.width), height: Number(values.height) },
    colorScheme: values.dark ? 'dark' : 'light',
    reducedMotion: 'reduce',
  });
  tab.setDefaultTimeout(kPatience);
  await tab.goto(`${pathToFileURL(page).href}#fine`);
  if (await tab.evaluate(() => Boolean(window.__buckens))) {
    await tab.locator('.scrub').evaluate((slider, fraction) => {
      slider.value = fraction;
      slider.dispatchEvent(new Event('input'));
    }, values.time);
  }
  if (values.scale) {
    await tab.locator('.field input[type=number]').fill(values.scale);
    await tab.keyboard.press('Enter');
  }
  for (const selector of values.click) await tab.locator(selector).first().click();
  for (const pair of values.select) {
    const [name, text] = pair.split('=');
    await tab.getByLabel(name, { exact: true }).selectOption({ label: text });
  }
  for (const number of values.follow) {
    await tab.getByLabel('Number of the node').fill(number);
    await tab.keyboard.press('Enter');
  }
  if (values.press.length > 0) await tab.locator('.view canvas').first().focus();
  for (const key of values.press) await tab.keyboard.press(key);
  // No frame around what was pressed last.
  await tab.evaluate(() => document.activeElement?.blur());
  // Two pictures: the first lays out, the second has everything in place.
  await tab.evaluate(
    () =>
      new Promise((done) =>
        requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))),
      ),
  );
  await tab.screenshot({ path: out });
} finally {
  await browser.close();
}
