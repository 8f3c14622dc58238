import type { Charts } from './charts';
import type { ViewerState } from './hook';
import type { ModeShapes } from './modes';
import type { Pane } from './pane';
import type { Pick } from './picks';
import type { Playback } from './playback';
import type { Run } from './run';
import type { ViewOptions } from './view_options';

/** The parts of a page that know what is on the screen. */
export interface PageParts {
  runs: Run[];
  options: ViewOptions;
  playback: Playback;
  /** The first one leads. */
  panes: Pane[];
  shapes: ModeShapes[];
  picks: Pick[];
  cursors: ReturnType<Charts['cursors']>;
  /** Range of the field shown; not-a-number without one. */
  present: number[];
  drawn: number;
}

/** What is on the screen, in plain numbers. */
export function pageState(page: PageParts): ViewerState {
  const { options, panes, present } = page;
  const { time, playing, speed } = page.playback;
  const leader = panes[0]!.stage;
  return {
    time,
    playing,
    speed,
    ...options,
    frame: leader?.motion.place.index ?? 0,
    orthographic: leader?.rig.orthographic ?? false,
    drawn: page.drawn,
    size: leader?.bounds.size ?? 0,
    cursors: page.cursors,
    mode: page.shapes[0]?.index ?? null,
    amplitude: page.shapes[0]?.amplitude ?? null,
    present: Number.isFinite(present[0]) ? (present as [number, number]) : null,
    cost: leader?.cost ?? { update: 0, render: 0 },
    picks: page.picks.flatMap((pick) => {
      const { stage } = panes[pick.pane]!;
      if (!stage) return [];
      const body = page.runs[pick.pane]!.bodies[pick.body]!.name;
      const screen = stage.project(stage.placeOf(pick, options.scale));
      return { pane: pick.pane, body, node: pick.node, screen };
    }),
    cameras: panes.flatMap(({ stage }) => (stage ? [stage.rig.direction] : [])),
    bodies: (leader?.motion.bodies ?? []).map((motion) => ({
      name: motion.body.name,
      pose: [...motion.pose],
      screen: leader!.project(motion.toWorld([0, 0, 0])),
    })),
  };
}
