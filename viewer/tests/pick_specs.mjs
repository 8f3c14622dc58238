// Following nodes, the keys, and the colours of the page.
import assert from 'node:assert/strict';
import { colors, difference, open, openRange, pixels, setTime, settle, state } from './browser_page.mjs';
import { asOpened, openCube } from './cube_page.mjs';

export async function pickSpecs({ test, browser, variant }) {
  const { tab, complaints } = await openCube(browser, variant);

  await test('a click on a body follows the nearest node, another lets it go', async () => {
    const box = await tab.locator('.view').boundingBox();
    const [x, y] = [box.x + 0.5 * box.width - 40, box.y + 0.55 * box.height];
    await tab.mouse.click(x, y);
    await settle(tab);
    const [pick] = (await state(tab)).picks;
    assert.equal(pick.body, 'cube');
    // The nearest node is within half an element, which is some 100 px here.
    assert.ok(Math.hypot(box.x + pick.screen.x - x, box.y + pick.screen.y - y) < 120);
    const line = tab.locator('.picks li');
    assert.match(await line.innerText(), /node cube 1\d\d/);
    assert.match(await line.innerText(), /MPa|not recorded/);
    assert.match(await line.innerText(), /at .* m/);
    assert.equal(await tab.locator('.chart[data-name^="von Mises"]').count(), 1);
    await tab.getByRole('button', { name: /Do not follow node cube/ }).click();
    assert.equal((await state(tab)).picks.length, 0);
    assert.equal(await tab.locator('.chart').count(), 0);
    await tab.mouse.click(box.x + 40, box.y + 0.6 * box.height);
    assert.equal((await state(tab)).picks.length, 0, 'the background has a node');
    assert.deepEqual(complaints, []);
  });

  await test('nodes are followed by number; value and curve are those of the field', async () => {
    await asOpened(tab);
    await tab.getByLabel('Field', { exact: true }).selectOption({ label: 'Stress xx' });
    const number = tab.getByLabel('Number of the node');
    await number.fill('126');
    await number.press('Enter');
    await settle(tab);
    assert.match(await tab.locator('.picks li').innerText(), /node cube 126\s+4\.00\d? MPa/);
    await number.fill('120');
    await number.press('Enter');
    await settle(tab);
    assert.match(await tab.locator('.picks li').last().innerText(), /node cube 120\s+4\.00\d? MPa/);
    await setTime(tab, 0.5);
    assert.match(await tab.locator('.picks li').first().innerText(), /[12]\.\d+ MPa/);
    const chart = tab.locator('.chart[data-name="Stress xx"] .legend');
    assert.match(await chart.innerText(), /cube 126\s+[12]\./);
    await tab.getByLabel('Field', { exact: true }).selectOption({ label: 'Displacement x' });
    await settle(tab);
    assert.equal(await tab.locator('.chart[data-name="Displacement x"]').count(), 1);
    assert.match(await tab.locator('.picks li').first().innerText(), /0\.1\d+ m/);
    await number.fill('5');
    await number.press('Enter');
    await settle(tab);
    assert.match(await tab.locator('.pick-message').innerText(), /cube has no node 5 on its surface/);
  });

  await test('with one colour per element it is the element clicked; what a limit hides cannot be', async () => {
    await asOpened(tab);
    await openRange(tab);
    await tab.getByText('one colour per element').click();
    await tab.locator('.view canvas').focus();
    await tab.keyboard.press('3');
    await settle(tab);
    const box = await tab.locator('.view').boundingBox();
    const { x, y } = (await state(tab)).bodies[0].screen;
    const click = async (right, up) => {
      await tab.mouse.click(box.x + x + 12 * right, box.y + y - 12 * up);
      await settle(tab);
      return tab.locator('.picks li').allInnerTexts();
    };
    // The node in the middle of the upper face belongs to four elements of 5, 6, 7 and 8 MPa.
    for (const [right, up, value] of [
      [-1, -1, 5],
      [1, -1, 6],
      [-1, 1, 7],
      [1, 1, 8],
    ]) {
      assert.match((await click(right, up))[0], new RegExp(`node cube 122\\s+${value}\\.00\\d? MPa`));
      assert.deepEqual(await click(right, up), []);
    }
    await tab.getByLabel('Lower limit').fill('7.5');
    await tab.keyboard.press('Enter');
    await tab.getByLabel('Values beyond the limits').selectOption('hide');
    await settle(tab);
    assert.deepEqual(await click(-1, -1), [], 'a hidden element was picked');
    assert.equal((await click(1, 1)).length, 1);
    assert.deepEqual(complaints, []);
    await tab.close();
  });

  await test('nodes of beams are followed', async () => {
    const { tab } = await open(browser, variant('slider-crank'));
    // The rod is straight: the middle node is at the mass centre.
    await setTime(tab, Math.PI / 150);
    const at = (await state(tab)).bodies[1].screen;
    const box = await tab.locator('.view').boundingBox();
    await tab.mouse.click(box.x + at.x, box.y + at.y);
    const { picks } = await state(tab);
    await settle(tab);
    assert.equal(picks[0]?.body, 'rod');
    assert.match(await tab.locator('.picks li').innerText(), /MPa/);
    await tab.close();
  });

  await test('keys: camera, deformation, loads, theme, help', async () => {
    const { tab } = await open(browser, variant('solid'));
    await tab.locator('.view canvas').focus();
    const camera = async () => (await state(tab)).cameras[0];
    for (const [key, axis] of [
      ['1', 0],
      ['2', 1],
      ['3', 2],
    ]) {
      await tab.keyboard.press(key);
      assert.ok((await camera())[axis] > 0.99, `${key}: ${await camera()}`);
    }
    await tab.keyboard.press('0');
    const home = await pixels(tab);
    await tab.keyboard.press('+');
    const near = await pixels(tab);
    assert.ok(difference(home, near) > 1000, '+ does not bring nearer');
    await tab.keyboard.press('-');
    assert.ok(difference(home, await pixels(tab)) < 500, '− does not undo +');
    const from = await camera();
    await tab.keyboard.press('q');
    await tab.keyboard.press('PageUp');
    const turned = await camera();
    assert.ok(Math.hypot(...turned.map((x, i) => x - from[i])) > 0.2);
    const before = (await state(tab)).bodies[0].screen;
    await tab.keyboard.press('Shift+W');
    await tab.keyboard.press('Shift+PageDown');
    const moved = (await state(tab)).bodies[0].screen;
    assert.ok(moved.x < before.x - 10 && moved.y < before.y - 10, 'the view does not move');
    assert.ok(Math.hypot(...(await camera()).map((x, i) => x - turned[i])) < 1e-9, 'moving turns');
    await tab.keyboard.press(']');
    assert.equal((await state(tab)).scale, 1.5);
    await tab.keyboard.press('[');
    await setTime(tab, 1);
    const loaded = await pixels(tab);
    await tab.keyboard.press('a');
    assert.equal((await state(tab)).loads, false);
    assert.ok(difference(loaded, await pixels(tab)) > 100, 'loads are not drawn');
    await tab.keyboard.press('?');
    assert.match(await tab.locator('dialog[open]').innerText(), /next, previous field/);
    await tab.keyboard.press('Escape');
    await tab.close();
  });

  await test('the colours of the page follow the system, or the button', async () => {
    const { tab } = await open(browser, variant('solid'), { colorScheme: 'dark' });
    const mostly = async () => {
      const seen = [...colors(await pixels(tab))].sort((a, b) => b[1] - a[1]);
      return seen[0][0];
    };
    const isDark = () => tab.evaluate(() => document.documentElement.dataset.theme);
    assert.match(await isDark(), /dark$/);
    await tab.locator('[data-theme-choice]').click();
    await settle(tab);
    assert.match(await isDark(), /light$/);
    assert.equal(await mostly(), '15,15,15');
    await tab.keyboard.press('t');
    assert.match(await isDark(), /dark$/);
    await settle(tab); // The button's name follows with the next picture.
    assert.match(await tab.locator('[data-theme-choice]').getAttribute('aria-label'), /dark/);
    await tab.keyboard.press('t');
    await tab.emulateMedia({ colorScheme: 'light' });
    await settle(tab);
    assert.match(await isDark(), /light$/);
    await tab.close();
  });

  await test('everything that can be pressed has a name', async () => {
    const { tab } = await open(browser, variant('solid'));
    await tab.locator('.display summary').click();
    const nameless = await tab.evaluate(() =>
      [...document.querySelectorAll('button, input, select, canvas, aside, summary, dialog')]
        .filter((part) => {
          const label = part.getAttribute('aria-label') ?? part.closest('label')?.textContent;
          // A dialog is not called by all that it says.
          return !(label?.trim() || (part.tagName !== 'DIALOG' && part.textContent.trim()));
        })
        .map((part) => part.outerHTML.slice(0, 80)),
    );
    assert.deepEqual(nameless, []);
    // A slider between 0 and 1 says nothing: it reads what is shown beside it.
    const silent = 'input[type=range]:not([aria-valuetext])';
    assert.equal(await tab.locator(`${silent}:visible`).count(), 0);
    await tab.close();
  });
}
