import { el } from './dom';
import { Stage } from './stage';
import type { Bounds } from './bounds';
import type { Insets } from './camera_rig';
import type { FieldShading } from './field_material';
import type { Pick } from './picks';
import type { Run } from './run';
import type { Theme } from './theme';

/** A press that moves further than this turns the view; one that does not picks a node [CSS px]. */
const kStill = 4;

/** One of the views side by side: a run's stage in its part of the page. */
export class Pane {
  readonly root: HTMLElement;
  /** Null where the browser has no WebGL; `fault` says why. */
  readonly stage: Stage | null = null;
  readonly fault: string = '';

  /** `picked` gets the node of a click, null beside everything. */
  constructor(
    readonly run: Run,
    readonly title: string,
    bounds: Bounds,
    theme: Theme,
    shading: FieldShading,
    moved: () => void,
    picked: (pick: Omit<Pick, 'pane'> | null) => void,
  ) {
    this.root = el('div', { class: 'pane' });
    if (title) this.root.append(el('div', { class: 'pane-title' }, title));
    try {
      this.stage = new Stage(run, bounds, theme, shading, moved);
    } catch (error) {
      this.fault = String(error);
      return;
    }
    this.root.prepend(this.stage.canvas, this.stage.labels.root);
    this.listen(this.stage, picked);
  }

  private listen(stage: Stage, picked: (pick: Omit<Pick, 'pane'> | null) => void): void {
    let pressed: { x: number; y: number } | null = null;
    stage.canvas.addEventListener('pointerdown', (event) => {
      const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey;
      pressed = plain ? { x: event.clientX, y: event.clientY } : null;
    });
    stage.canvas.addEventListener('pointerup', (event) => {
      if (!pressed) return;
      const way = Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y);
      pressed = null;
      if (way > kStill) return;
      const box = stage.canvas.getBoundingClientRect();
      picked(stage.pick(event.clientX - box.left, event.clientY - box.top));
    });
  }

  resize(insets: Insets): void {
    this.stage?.resize(this.root.clientWidth, this.root.clientHeight, insets);
  }
}
