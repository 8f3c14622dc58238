import { niceBelow } from './quantity';
import { rangeOf } from './rows';
import { sourcesOf, type FieldSource, type Reduction } from './fields';
import { magnitude, misesOf, planeMisesOf, principalOf } from './tensor';
import type { FramePlace } from './interpolation';
import type { Run } from './run';

/** Number of places at which a source has a value. */
export function numPlaces({ rows, stride }: FieldSource): number {
  return rows.width / stride;
}

function reduce(reduction: Reduction, row: ArrayLike<number>, at: number): number {
  switch (reduction.kind) {
    case 'pick':
      return row[at + reduction.component]!;
    case 'magnitude':
      return magnitude(row, at);
    case 'mises':
      return misesOf(row, at);
    case 'planeMises':
      return planeMisesOf(row, at);
    case 'principal':
      return principalOf(row, at, reduction.component);
  }
}

/** Computes the values of one source; reuses its memory from frame to frame. */
export class FieldValues {
  readonly values: Float32Array;
  private readonly row: Float32Array;

  constructor(readonly source: FieldSource) {
    this.values = new Float32Array(numPlaces(source));
    const same = source.stride === 1 && source.reduction.kind === 'pick';
    this.row = same ? this.values : new Float32Array(source.rows.width);
  }

  at(place: FramePlace): Float32Array {
    const { rows, stride, reduction } = this.source;
    rows.interpolate(place, this.row);
    if (this.row === this.values) return this.values;
    for (let i = 0; i < this.values.length; i++) {
      this.values[i] = reduce(reduction, this.row, stride * i);
    }
    return this.values;
  }
}

/** Value of a source at one of its places in every frame. */
export function history(of: FieldSource, index: number, frames: number): Float32Array {
  const out = new Float32Array(frames);
  const row = new Float32Array(of.stride);
  for (let frame = 0; frame < frames; frame++) {
    for (let k = 0; k < of.stride; k++) row[k] = of.rows.value(frame, of.stride * index + k);
    out[frame] = reduce(of.reduction, row, 0);
  }
  return out;
}

/** Least and largest value of an item in all frames; [0, 0] if it has none. */
export function rangeOfRun(runs: Run[], id: string): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const body of runs.flatMap((run) => run.bodies)) {
    for (const of of sourcesOf(body).filter(({ item }) => item.id === id)) {
      const single = of.stride === 1 && of.reduction.kind === 'pick';
      const values = single ? null : new FieldValues(of);
      for (let index = 0; index < of.rows.frames; index++) {
        const [a, b] = values ? rangeOf(values.at({ index, fraction: 0 })) : of.rows.range(index);
        if (a < low) low = a;
        if (b > high) high = b;
      }
    }
  }
  return low <= high ? [low, high] : [0, 0];
}

/** Scale at which the largest deformation is visible: a twentieth of the machine, not below 1. */
export function visibleScale(runs: Run[], machine: number): number {
  const most = rangeOfRun(runs, 'displacement/magnitude')[1];
  return most > 0 ? Math.max(1, niceBelow((0.05 * machine) / most)) : 1;
}
