// The page of the stretched cube: several specs share one tab, each begins with the page as it opened.
import { open, setTime } from './browser_page.mjs';

/** As the page opened, but at the end of the run. */
export async function asOpened(tab) {
  await tab.evaluate(() => {
    const choose = (name, value) => {
      const control = document.querySelector(`select[aria-label="${name}"]`);
      control.value = value;
      control.dispatchEvent(new Event('change'));
    };
    for (const mark of ['per-element', 'flip']) {
      const box = document.querySelector(`[data-option="${mark}"]`);
      if (box.checked) box.click();
    }
    choose('Field', 'von_mises');
    choose('Range of the colours', 'run');
    choose('Values beyond the limits', 'none');
    choose('Colour scale', 'spectrum');
    choose('Number of colours', '0');
    choose('Section across', 'off');
    choose('Section through', '');
    choose('Edges of elements', 'auto');
    const colors = document.querySelector('[data-toggle="colors"]');
    if (colors.getAttribute('aria-pressed') === 'false') colors.click();
    for (const button of document.querySelectorAll('.picks button')) button.click();
    for (const details of document.querySelectorAll('details')) details.open = false;
  });
  await tab.locator('.view canvas').focus();
  await tab.keyboard.press('0');
  await tab.locator('.view canvas').blur();
  await setTime(tab, 1);
}

export async function openCube(browser, variant) {
  const opened = await open(browser, variant('solid'));
  await setTime(opened.tab, 1);
  return opened;
}
