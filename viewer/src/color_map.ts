type Stop = [number, number, number];

export type ColorMapName = 'spectrum' | 'viridis' | 'diverging';

/** Evenly spaced colours, sRGB 0 … 1. */
const kMaps: Record<ColorMapName, Stop[]> = {
  // Blue – cyan – green – yellow – red, all dark enough for both themes.
  spectrum: [
    [0.19, 0.28, 0.74],
    [0.16, 0.56, 0.87],
    [0.15, 0.74, 0.62],
    [0.48, 0.83, 0.32],
    [0.93, 0.82, 0.24],
    [0.95, 0.52, 0.17],
    [0.8, 0.14, 0.13],
  ],
  // Perceptually uniform, even without colour vision.
  viridis: [
    [0.267, 0.005, 0.329],
    [0.275, 0.196, 0.496],
    [0.213, 0.359, 0.552],
    [0.153, 0.497, 0.558],
    [0.122, 0.633, 0.53],
    [0.289, 0.758, 0.428],
    [0.626, 0.854, 0.223],
    [0.993, 0.906, 0.144],
  ],
  // For signed values: blue below, red above, grey between.
  diverging: [
    [0.17, 0.3, 0.72],
    [0.46, 0.61, 0.94],
    [0.8, 0.83, 0.87],
    [0.94, 0.6, 0.48],
    [0.72, 0.08, 0.16],
  ],
};

export const kColorMaps = Object.keys(kMaps) as ColorMapName[];

/** Colour of a fraction of the range, clamped to it. */
export function colorAt(fraction: number, map: ColorMapName = 'spectrum'): Stop {
  const stops = kMaps[map];
  const f =
    Math.min(1, Math.max(0, Number.isFinite(fraction) ? fraction : 0)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(f));
  const [a, b] = [stops[i]!, stops[i + 1]!];
  return [0, 1, 2].map((k) => a[k]! + (f - i) * (b[k]! - a[k]!)) as Stop;
}

/** 256 colours as RGBA bytes. */
export function colorTable(map: ColorMapName): Uint8Array<ArrayBuffer> {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) {
    const color = colorAt(i / 255, map).map((x) => Math.round(255 * x));
    table.set([...color, 255], 4 * i);
  }
  return table;
}

/** The same scale as a CSS gradient along --upwards (from bottom to top without it), in `bands` steps if above zero. */
export function cssGradient(map: ColorMapName, bands = 0): string {
  const css = (f: number) => {
    const color = colorAt(f, map);
    return `rgb(${color.map((x) => Math.round(255 * x)).join(' ')})`;
  };
  const count = bands || 24;
  const stops = [...Array(count)].map((_, i) => {
    const [from, to] = [(100 * i) / count, (100 * (i + 1)) / count];
    return bands ? `${css((i + 0.5) / count)} ${from}% ${to}%` : css(i / (count - 1));
  });
  return `linear-gradient(var(--upwards, to top), ${stops.join(', ')})`;
}
