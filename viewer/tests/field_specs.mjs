// Colours of a field, its scale, sections and edges, checked in the picture.
import assert from 'node:assert/strict';
import { colorAt, colors, difference, open, openRange, pixels, setTime, settle, state } from './browser_page.mjs';
import { asOpened, openCube } from './cube_page.mjs';

async function texts(tab, selector) {
  await settle(tab);
  return (await tab.locator(selector).allInnerTexts()).map((text) => text.trim());
}
const legend = (tab) => texts(tab, '.field-panel .ticks span');

export async function fieldSpecs({ test, browser, variant }) {
  const { tab, complaints } = await openCube(browser, variant);

  await test('solids: the surface deforms and shows its stresses', async () => {
    assert.equal(await tab.locator('.field-panel .item').inputValue(), 'von_mises');
    assert.deepEqual(await texts(tab, '.field-panel .scale .unit'), ['MPa']);
    // Of both: the tensor at the nodes reaches 4 MPa, the elements' own field 8 MPa.
    assert.deepEqual(await legend(tab), ['8.00', '6.00', '4.00', '2.00', '0']);
    const coloured = await pixels(tab);
    await tab.locator('button[data-toggle=colors]').click();
    const plain = await pixels(tab);
    assert.equal(await tab.locator('.field-panel').isVisible(), false);
    assert.ok(difference(coloured, plain) > 500, 'stresses give no colour');
    await tab.keyboard.press('s');
    await setTime(tab, 0);
    assert.ok(difference(coloured, await pixels(tab)) > 500, 'nothing moves');
  });

  await test('fields are chosen from a list and by key; blue is low, red is high', async () => {
    await asOpened(tab);
    const item = tab.getByLabel('Field', { exact: true });
    await item.selectOption({ label: 'Displacement x' });
    assert.equal((await state(tab)).field.item, 'displacement/x');
    assert.deepEqual(await legend(tab), ['0.300', '0.150', '0', '−0.150', '−0.300']);
    assert.match((await texts(tab, '.field-panel .now'))[0], /−0\.300 … 0\.300/);
    assert.equal(await tab.getByRole('img', { name: /Displacement x in colour/ }).count(), 1);
    // Seen from above x goes to the right.
    await tab.locator('.view canvas').focus();
    await tab.keyboard.press('3');
    const box = await tab.locator('.view').boundingBox();
    const seen = await pixels(tab);
    const middle = (await state(tab)).bodies[0].screen;
    const strip = [-0.15, 0.15].map((u) => colorAt(seen, middle.x + u * box.height, middle.y + 0.08 * box.height));
    assert.ok(strip[0][2] > strip[0][0] + 40, `left is not blue: ${strip[0]}`);
    assert.ok(strip[1][0] > strip[1][2] + 40, `right is not red: ${strip[1]}`);
    await tab.keyboard.press('v');
    assert.equal((await state(tab)).field.item, 'displacement/y');
    await tab.keyboard.press('Shift+V');
    assert.equal((await state(tab)).field.item, 'displacement/x');
  });

  await test('the range is that of the run, of the picture, or typed', async () => {
    await asOpened(tab);
    await openRange(tab);
    await tab.getByLabel('Field', { exact: true }).selectOption({ label: 'Stress xx' });
    assert.equal((await legend(tab))[0], '4.00');
    await setTime(tab, 0.5);
    await tab.getByLabel('Range of the colours').selectOption('frame');
    await settle(tab);
    assert.match((await legend(tab))[0], /^2\.0/);
    await tab.getByLabel('Upper end of the colours').fill('10');
    await tab.keyboard.press('Tab');
    await settle(tab);
    assert.equal((await legend(tab))[0], '10.0');
    assert.equal((await state(tab)).field.range, 'fixed');
    assert.equal((await state(tab)).field.high, 1e7);
  });

  await test('values beyond a limit turn grey, or are hidden', async () => {
    await asOpened(tab);
    await openRange(tab);
    await tab.getByLabel('Field', { exact: true }).selectOption({ label: 'Stress xx' });
    const all = await pixels(tab);
    await tab.getByLabel('Lower limit').fill('2');
    await tab.keyboard.press('Enter');
    await tab.getByLabel('Values beyond the limits').selectOption('grey');
    const grey = await pixels(tab);
    assert.ok(difference(all, grey) > 5000, 'nothing turned grey');
    await tab.getByLabel('Values beyond the limits').selectOption('hide');
    assert.equal((await state(tab)).field.cutLow, 2e6);
    assert.ok(difference(grey, await pixels(tab)) > 5000, 'nothing was hidden');
  });

  await test('one colour per element, and scales in steps', async () => {
    await asOpened(tab);
    await openRange(tab);
    const count = async () => [...colors(await pixels(tab)).values()].filter((n) => n > 400).length;
    const smooth = await pixels(tab);
    await tab.getByText('one colour per element').click();
    assert.equal((await state(tab)).field.perElement, true);
    const flat = await pixels(tab);
    assert.ok(difference(smooth, flat) > 3000, 'elements look like nodes');
    await tab.getByLabel('Field', { exact: true }).selectOption({ label: 'Displacement x' });
    await tab.getByText('one colour per element').click();
    const continuous = await count();
    await tab.getByLabel('Number of colours').selectOption('6');
    assert.ok((await count()) < continuous, 'steps give no fewer colours');
    const spectrum = await pixels(tab);
    await tab.getByLabel('Colour scale').selectOption('viridis');
    assert.ok(difference(spectrum, await pixels(tab)) > 3000);
  });

  await test('a section opens the body; edges come and go', async () => {
    await asOpened(tab);
    const whole = await pixels(tab);
    await tab.locator('.display summary').click();
    await tab.getByLabel('Section across').selectOption('x');
    await tab.getByLabel('Section at').evaluate((slider) => {
      slider.value = 0.4;
      slider.dispatchEvent(new Event('input'));
    });
    assert.match((await texts(tab, '.popover output'))[0], / m$/);
    const cut = await pixels(tab);
    assert.ok(difference(whole, cut) > 5000, 'nothing is cut');
    await tab.getByText('keep the other side').click();
    assert.ok(difference(cut, await pixels(tab)) > 5000, 'the other side looks the same');
    await tab.getByLabel('Section through').selectOption({ label: 'cube' });
    assert.equal((await state(tab)).section.body, 'cube');
    await tab.getByLabel('Section across').selectOption('off');
    const before = await pixels(tab);
    await tab.getByLabel('Edges of elements').selectOption('none');
    assert.ok(difference(before, await pixels(tab)) > 300, 'edges stay');
    await tab.getByLabel('Edges of elements').selectOption('wireframe');
    assert.ok(difference(before, await pixels(tab)) > 3000, 'faces stay');
    await tab.keyboard.press('Escape');
    await settle(tab);
    assert.equal(await tab.locator('.display[open]').count(), 0);
    await tab.locator('.view canvas').focus();
    await tab.keyboard.press('x');
    assert.equal((await state(tab)).section.axis, 'x');
    await tab.keyboard.press('e');
    assert.equal((await state(tab)).edges, 'auto');
  });

  await test('no errors, no warnings, no requests while fields are chosen', async () => {
    assert.deepEqual(complaints, []);
    await tab.close();
  });

  await test('20 000 triangles: colours, section and element colours without complaints', async () => {
    const { tab, complaints } = await open(browser, variant('large'));
    await setTime(tab, 0.022);
    const { cost, present } = await state(tab);
    assert.ok(cost.update > 0 && present[1] > 1e8);
    assert.ok(colors(await pixels(tab)).size > 30);
    await openRange(tab);
    await tab.getByText('one colour per element').click();
    await tab.locator('.view canvas').focus();
    await tab.keyboard.press('x');
    await settle(tab);
    assert.equal(await tab.locator('.chips').innerText().then((t) => /6 of 60/.test(t)), true);
    assert.deepEqual(complaints, []);
    await tab.close();
  });
}
