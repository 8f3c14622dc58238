import type { Insets } from './camera_rig';

/** Narrower views have the colour scale above the picture instead of beside it [CSS px]. */
const kNarrow = 560;
/** Height of the texts at the bottom of the view [CSS px]. */
const kBottom = 30;

/**
 * Areas covered by the controls over the view. The colour scale is across views of two runs and narrow
 * ones, beside the picture in others.
 */
export function insetsOf(view: HTMLElement, scale: HTMLElement, two: boolean): Insets {
  const box = view.getBoundingClientRect();
  scale.classList.toggle('strip', two || box.width < kNarrow);
  const bars = view.querySelector('.bars')!.getBoundingClientRect();
  const panel = scale.getBoundingClientRect();
  const insets = { left: 0, top: bars.bottom - box.top, right: 0, bottom: kBottom };
  if (panel.height > 0 && panel.width < 0.6 * box.width) insets.right = box.right - panel.left;
  else if (panel.height > 0) insets.top = panel.bottom - box.top;
  return insets;
}
