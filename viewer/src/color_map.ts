/** Blue – cyan – green – yellow – red, evenly dark enough for both themes; sRGB 0 … 1. */
const kStops: [number, number, number][] = [
  [0.19, 0.28, 0.74],
  [0.16, 0.56, 0.87],
  [0.15, 0.74, 0.62],
  [0.48, 0.83, 0.32],
  [0.93, 0.82, 0.24],
  [0.95, 0.52, 0.17],
  [0.8, 0.14, 0.13],
];

/** Colour of a fraction of the range, clamped to it. */
export function colorAt(fraction: number): [number, number, number] {
  const f =
    Math.min(1, Math.max(0, Number.isFinite(fraction) ? fraction : 0)) * (kStops.length - 1);
  const i = Math.min(kStops.length - 2, Math.floor(f));
  const [a, b] = [kStops[i]!, kStops[i + 1]!];
  return [0, 1, 2].map((k) => a[k]! + (f - i) * (b[k]! - a[k]!)) as [number, number, number];
}

/** The same scale as a CSS gradient from bottom to top. */
export function cssGradient(): string {
  const stops = kStops.map((c) => `rgb(${c.map((x) => Math.round(255 * x)).join(' ')})`);
  return `linear-gradient(to top, ${stops.join(', ')})`;
}
