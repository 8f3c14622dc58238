import { el } from './dom';
import { figure, prefixFor } from './quantity';
import type { Pane } from './pane';
import type { Playback } from './playback';
import type { Run } from './run';
import type { ViewOptions } from './view_options';

/** Text shown instead of a picture or of a motion; empty if there are both. */
export function notice(run: Run, panes: Pane[], playback: Playback): string {
  const fault = panes.find((pane) => pane.fault)?.fault;
  if (fault) return `The 3-D view needs WebGL, which this browser does not offer (${fault}).`;
  if (run.bodies.length === 0) return 'This run has no bodies to draw.';
  if (run.times.length === 1) return 'One stored frame only: there is nothing to play.';
  if (!playback.canPlay) return 'All frames are at one time: there is nothing to play.';
  return '';
}

/** Texts in the corner, and what a screen reader says about the picture. */
export class Captions {
  readonly corner = el('div', { class: 'grid-text' });
  readonly status = el('div', { class: 'unseen', role: 'status' });

  /** @param field label of the field in colour, empty without one */
  update(panes: Pane[], options: ViewOptions, playback: Playback, field: string): void {
    const leader = panes[0]!.stage!;
    const { factor, unit } = prefixFor(leader.gridSpacing, 'm');
    const grid = `grid ${figure(leader.gridSpacing / factor, 1)} ${unit}`;
    const scale = options.scale === 1 ? '' : `deformation × ${figure(options.scale, 3)} · `;
    this.corner.textContent = scale + grid;
    if (playback.playing) return;
    const shown = field ? `, ${field} in colour` : '';
    panes.forEach(({ run, title, stage }) => {
      const time = `${figure(playback.time, 4)} ${run.clock}`;
      const text = `${title || run.title} at ${time}${shown}. Drag to turn, wheel to zoom, click to follow a node; ? lists the keys.`;
      if (stage && stage.canvas.ariaLabel !== text) stage.canvas.ariaLabel = text;
    });
    if (this.status.textContent !== field) this.status.textContent = field;
  }
}
