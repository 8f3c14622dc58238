import type { ColorMapName } from './color_map';
import type { EdgeChoice } from './skin';

/** Which values of a field get which colour. */
export interface FieldChoice {
  /** Id of the item. */
  item: string;
  /** Range of the colours: over the whole run, of the present picture, or as typed. */
  range: 'run' | 'frame' | 'fixed';
  low: number;
  high: number;
  /** One colour per element instead of smooth ones. */
  perElement: boolean;
  map: ColorMapName;
  /** Number of colours, 0 for a continuous scale. */
  bands: number;
  /** Treatment of values beyond the limits. */
  cut: 'none' | 'grey' | 'hide';
  /** Limits; null for none. */
  cutLow: number | null;
  cutHigh: number | null;
}

/** A plane that cuts bodies open. */
export interface SectionChoice {
  axis: 'off' | 'x' | 'y' | 'z';
  /** Name of the only body that is cut, in its axes; empty for the world and all bodies. */
  body: string;
  /** Position 0 … 1 within the extent along the axis. */
  fraction: number;
  /** Keeps the other side. */
  flip: boolean;
}

/** What the user chose to see. */
export interface ViewOptions {
  frames: boolean;
  joints: boolean;
  loads: boolean;
  /** Forces and torques of joints as arrows. */
  reactions: boolean;
  labels: boolean;
  undeformed: boolean;
  /** Whether a field is shown in colour at all. */
  colors: boolean;
  field: FieldChoice;
  edges: EdgeChoice;
  section: SectionChoice;
  /** Magnification of nodal displacements and rotations. */
  scale: number;
  /** Traced point, null for none. */
  trace: TracePoint | null;
}

/** By name, so that it means the same in two runs side by side. */
export interface TracePoint {
  body: string;
  /** Marker of the body, empty for the mass centre. */
  marker: string;
}
