import { chartSeries } from './charts';
import type { Run } from './run';

/**
 * Values below this fraction of the usual size in the run are rounding errors of zero. Recorded
 * numbers carry 16 digits, and equations lose some of them.
 */
const kRounding = 1e-11;

function largestOf(values: ArrayLike<number>): number {
  let most = 0;
  for (let i = 0; i < values.length; i++) {
    const size = Math.abs(values[i]!);
    if (size > most && size < Infinity) most = size;
  }
  return most;
}

/** Typical sizes of the quantities of a run, by unit: values far below are regarded as zero. */
export class Magnitudes {
  private readonly largest = new Map<string, number>();

  /** @param size of the model [m] */
  constructor(runs: Run[], size: number) {
    for (const run of runs) {
      const n = run.times.length;
      const duration = n > 1 ? run.times[n - 1]! - run.times[0]! : 0;
      this.raise('m', size);
      this.raise('rad', 1);
      if (duration > 0 && run.clock === 's') {
        this.raise('m/s', size / duration);
        this.raise('rad/s', 1 / duration);
        this.raise('m/s^2', size / duration ** 2);
        this.raise('rad/s^2', 1 / duration ** 2);
      }
      for (const { unit, values } of chartSeries(run)) this.raise(unit, largestOf(values));
      for (const { force, torque } of run.joints) {
        if (force) this.raise('N', largestOf(force));
        if (torque) this.raise('N m', largestOf(torque));
      }
    }
    // A torque of a force on an arm as short as rounding errors is zero.
    this.raise('N m', size * (this.largest.get('N') ?? 0));
  }

  private raise(unit: string, value: number): void {
    this.largest.set(unit, Math.max(this.largest.get(unit) ?? 0, value));
  }

  /** Smaller values of this unit are shown as zero. */
  least(unit: string): number {
    return kRounding * (this.largest.get(unit) ?? 0);
  }

  /** A range of values of this unit, [0, 0] if all of them are shown as zero. */
  visible([low, high]: [number, number], unit: string): [number, number] {
    return Math.max(Math.abs(low), Math.abs(high)) < this.least(unit) ? [0, 0] : [low, high];
  }
}
