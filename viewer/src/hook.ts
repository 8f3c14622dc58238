import type { ViewOptions } from './view_options';

/** Result of `window.__buckens.state()`: what is on the screen, in plain numbers. */
export interface ViewerState extends ViewOptions {
  /** [s] */
  time: number;
  playing: boolean;
  /** Simulated seconds per second. */
  speed: number;
  /** Stored frame at or before the time. */
  frame: number;
  orthographic: boolean;
  /** Pictures drawn so far. */
  drawn: number;
  /** Diagonal of the box around the whole run [m]. */
  size: number;
  /** Number of the mode shown from 0, null in runs. */
  mode: number | null;
  /** Its largest displacement over the model's size, null in runs. */
  amplitude: number | null;
  /** Range of the field shown at the current time; null without one. */
  present: [number, number] | null;
  /** Processor time for the last picture: shapes and colours; transfer [ms]. */
  cost: { update: number; render: number };
  /** Followed nodes: run, body, node, and position in the view [CSS px]. */
  picks: { pane: number; body: string; node: number; screen: { x: number; y: number } }[];
  /** Direction from the target to the camera, of every view. */
  cameras: [number, number, number][];
  /** Time cursor of each panel shown [CSS px from the left end of its axis]. */
  cursors: { name: string; x: number }[];
  /** Pose (position, quaternion w x y z) and position of the mass centre in the view [CSS px]. */
  bodies: { name: string; pose: number[]; screen: { x: number; y: number } }[];
}

/** What a newer page of the same run takes over from the one it replaces, as plain data. */
export interface Kept {
  options: ViewOptions;
  time: number;
  /** The time was that of the last frame: it stays so. */
  isAtEnd: boolean;
  playing: boolean;
  speed: number;
  camera: KeptCamera | null;
}

/** Where the camera is [model units: the size of the run]. */
export interface KeptCamera {
  orthographic: boolean;
  height: number;
  zoom: number;
  position: number[];
  target: number[];
}

declare global {
  interface Window {
    /** For tests and scripts: `setTime` pauses and shows time t [s]. */
    __buckens?: {
      setTime(t: number): void;
      state(): ViewerState;
      /** For `buckens view --live`, which replaces the page while the run goes on. */
      keep(): Kept;
      adopt(kept: Kept): void;
    };
  }
}
