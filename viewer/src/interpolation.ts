/** A place between two stored frames: frame `index`, and `fraction` of the way to the next one. */
export interface FramePlace {
  index: number;
  fraction: number;
}

/** Frame interval that contains t, clamped to the run. Frames may be unevenly spaced. */
export function locate(times: ArrayLike<number>, t: number): FramePlace {
  const last = times.length - 1;
  if (last <= 0 || !(t > times[0]!)) return { index: 0, fraction: 0 };
  if (t >= times[last]!) return { index: last, fraction: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= t) low = middle;
    else high = middle;
  }
  const span = times[high]! - times[low]!;
  return { index: low, fraction: span > 0 ? (t - times[low]!) / span : 0 };
}

/** Rows of `width` numbers, interpolated linearly into `out`. */
export function interpolateRow(
  values: Float32Array,
  width: number,
  place: FramePlace,
  out: Float32Array | number[],
): void {
  const a = place.index * width;
  const f = place.fraction;
  if (f === 0) {
    for (let i = 0; i < width; i++) out[i] = values[a + i]!;
    return;
  }
  const b = a + width;
  for (let i = 0; i < width; i++) out[i] = values[a + i]! * (1 - f) + values[b + i]! * f;
}

/** Shortest great-circle path between unit quaternions stored at offsets a and b of `values`. */
function slerp(values: Float32Array, a: number, b: number, f: number, out: number[]): void {
  let dot = 0;
  for (let i = 0; i < 4; i++) dot += values[a + i]! * values[b + i]!;
  const sign = dot < 0 ? -1 : 1;
  const cosine = Math.min(1, Math.abs(dot));
  let wa = 1 - f;
  let wb = f;
  // Below 1e-3 rad the chord differs from the arc by less than float32 rounding.
  if (cosine < 1 - 5e-7) {
    const angle = Math.acos(cosine);
    wa = Math.sin((1 - f) * angle) / Math.sin(angle);
    wb = Math.sin(f * angle) / Math.sin(angle);
  }
  let norm = 0;
  for (let i = 0; i < 4; i++) {
    out[3 + i] = wa * values[a + i]! + sign * wb * values[b + i]!;
    norm += out[3 + i]! ** 2;
  }
  norm = Math.sqrt(norm) || 1;
  for (let i = 3; i < 7; i++) out[i]! /= norm;
}

/** Pose (px, py, pz, qw, qx, qy, qz) between frames: position linear, rotation by slerp. */
export function interpolatePose(pose: Float32Array, place: FramePlace, out: number[]): void {
  const a = place.index * 7;
  const b = place.fraction > 0 ? a + 7 : a;
  for (let i = 0; i < 3; i++) {
    out[i] = pose[a + i]! * (1 - place.fraction) + pose[b + i]! * place.fraction;
  }
  slerp(pose, a + 3, b + 3, place.fraction, out);
}
