import { rotate } from './motion';
import { Pane } from './pane';
import { nodeAt, type Run } from './run';
import type { Bounds } from './bounds';
import type { Insets } from './camera_rig';
import type { FieldShading } from './field_material';
import type { Pick } from './picks';
import type { Theme } from './theme';
import type { Triple } from './page_data';

const kAxes: Triple[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
/** Towards the camera, for planar models viewed from the corner. */
const kCorner: Triple = [0.55, 0.45, 0.7];

export interface ViewEvents {
  /** The camera has moved. */
  changed(): void;
  /** A node was clicked. */
  picked(pick: Pick): void;
}

/** The pictures of all runs side by side; they share one camera. */
export class Views {
  readonly panes: Pane[];

  /** @param titles one per run, empty for a single one */
  constructor(
    private readonly runs: Run[],
    titles: string[],
    bounds: Bounds,
    theme: Theme,
    shading: FieldShading,
    private readonly events: ViewEvents,
  ) {
    this.panes = runs.map((run, pane) => {
      const moved = () => this.moved(pane);
      return new Pane(run, titles[pane]!, bounds, theme, shading, moved, (pick) => {
        if (pick) events.picked({ ...pick, pane });
      });
    });
  }

  /** The view whose camera the others follow. */
  get leader() {
    return this.panes[0]!.stage;
  }

  /** Along axis 0, 1, 2; −1: from the corner. */
  lookAlong(axis: number): void {
    if (axis >= 0) this.leader?.fit(kAxes[axis]);
    else if (this.runs[0]!.planar) this.leader?.fit(kCorner);
    else this.leader?.fitHome();
  }

  /** Parallel or perspective. */
  project(): void {
    this.leader?.rig.setOrthographic(!this.leader.rig.orthographic);
    this.events.changed();
  }

  resize(insets: Insets): void {
    for (const pane of this.panes) pane.resize(insets);
  }

  setTheme(theme: Theme): void {
    for (const { stage } of this.panes) stage?.setTheme(theme);
  }

  /** Range of the field in all views; NaN without one. */
  present(): [number, number] {
    const all = this.panes.flatMap(({ stage }) => stage?.present ?? []).filter(Number.isFinite);
    return all.length ? [Math.min(...all), Math.max(...all)] : [NaN, NaN];
  }

  /** Position of a node [m], deformed. */
  placeOf(pick: Pick): Triple {
    return this.panes[pick.pane]!.stage?.placeOf(pick, 1) ?? [NaN, NaN, NaN];
  }

  /** Undeformed position of a node [m]: vibrations have an arbitrary size. */
  restingPlaceOf(pick: Pick): Triple {
    const body = this.runs[pick.pane]!.bodies[pick.body]!;
    const turned = rotate(body.pose, 3, nodeAt(body, pick.node));
    return turned.map((x, i) => x + body.pose[i]!) as Triple;
  }

  /** The camera of one view has moved: the others look from there too. */
  private moved(index: number): void {
    const from = this.panes?.[index]?.stage;
    if (from) {
      for (const { stage } of this.panes) if (stage && stage !== from) stage.rig.follow(from.rig);
    }
    this.events.changed();
  }
}
