/** Duration of the whole run at the default speed [s]. */
const kDefaultWatch = 8;

/** The clock of the animation: time, speed and whether it runs; draws nothing. */
export class Playback {
  time: number;
  playing = false;
  /** Simulated seconds per second of the wall clock. */
  speed: number;

  constructor(private readonly times: Float64Array) {
    this.time = this.start;
    // Two digits: "0.013×" is read more easily than "0.0125×".
    this.speed = this.duration > 0 ? Number((this.duration / kDefaultWatch).toPrecision(2)) : 1;
  }

  get start(): number {
    return this.times[0] ?? 0;
  }

  get end(): number {
    return this.times[this.times.length - 1] ?? 0;
  }

  get duration(): number {
    return this.end - this.start;
  }

  get canPlay(): boolean {
    return this.duration > 0;
  }

  get fraction(): number {
    return this.canPlay ? (this.time - this.start) / this.duration : 0;
  }

  setTime(t: number): void {
    if (!Number.isFinite(t)) return;
    this.time = Math.min(this.end, Math.max(this.start, t));
  }

  setFraction(fraction: number): void {
    this.setTime(this.start + fraction * this.duration);
  }

  /** To the stored frame `frames` away from the current one. */
  stepFrames(frames: number): void {
    const last = this.times.length - 1;
    let nearest = 0;
    for (let i = 1; i <= last; i++) {
      const better =
        Math.abs(this.times[i]! - this.time) < Math.abs(this.times[nearest]! - this.time);
      if (better) nearest = i;
    }
    this.setTime(this.times[Math.min(last, Math.max(0, nearest + frames))] ?? this.time);
  }

  /** Advances by `seconds` of wall-clock time; at the end the run starts again. */
  advance(seconds: number): void {
    if (!this.playing || !this.canPlay) return;
    const t = this.time + seconds * this.speed;
    this.time = t <= this.end ? t : this.start + ((t - this.start) % this.duration);
  }
}
