/** What the user chose to see. */
export interface ViewOptions {
  frames: boolean;
  joints: boolean;
  labels: boolean;
  undeformed: boolean;
  stress: boolean;
  /** Magnification of nodal displacements and rotations. */
  scale: number;
  /** Traced point, null for none. */
  trace: TracePoint | null;
}

export interface TracePoint {
  body: number;
  /** Index into the body's markers, −1 for the mass centre. */
  marker: number;
}
