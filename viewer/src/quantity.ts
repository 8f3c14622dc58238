/** Formats of numbers: engineering prefixes for axes, short figures for people. */

export interface Prefix {
  factor: number;
  unit: string;
}

const kPrefixes: [number, string][] = [
  [1e-9, 'n'],
  [1e-6, 'µ'],
  [1e-3, 'm'],
  [1, ''],
  [1e3, 'k'],
  [1e6, 'M'],
  [1e9, 'G'],
];
const kUpAndDown = /^(N|N m|Pa|J|W|J\/m\^3)$/;
const kDownOnly = /^(m|m\/s|s|rad)$/;

/** The prefix under which `largest` has one to three digits before the point. */
export function prefixFor(largest: number, unit: string): Prefix {
  const plain = { factor: 1, unit };
  if (!(largest > 0) || !Number.isFinite(largest)) return plain;
  const down = kDownOnly.test(unit);
  if (!down && !kUpAndDown.test(unit)) return plain;
  const allowed = kPrefixes.filter(([factor]) => !down || factor <= 1);
  // 0.2 m stays 0.2 m: the plain unit is kept while one leading zero is enough.
  const fitting = allowed.filter(([factor]) => largest >= (factor === 1 ? 0.1 : 1) * factor);
  const [factor, prefix] = fitting[fitting.length - 1] ?? allowed[0]!;
  return { factor, unit: prefix + unit };
}

/** Keeps trailing zeros; never an exponent. */
function plain(value: number, digits: number): string {
  const text = value.toPrecision(digits);
  return text.includes('e') ? String(Number(text)) : text;
}

/** Four significant digits, exponent only where it shortens. */
export function figure(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text =
    size >= 1e5 || size < 1e-3
      ? value.toExponential(Math.min(2, digits - 1))
      : plain(value, digits);
  return text.replace('-', '−').replace('e+', 'e').replace('e-', 'e−');
}

/** 1, 2 or 5 times a power of ten, not above `value`. */
export function niceBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** Time, or length of a path in steps, with the fixed number of digits that suits the run's duration. */
export class TimeFormat {
  private readonly prefix: Prefix;
  private readonly decimals: number;

  constructor(duration: number, unit: 's' | 'steps') {
    this.prefix = prefixFor(duration, unit);
    const shown = duration / this.prefix.factor || 1;
    this.decimals = Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(shown))));
  }

  get unit(): string {
    return this.prefix.unit;
  }

  number(t: number): string {
    return (t / this.prefix.factor).toFixed(this.decimals).replace('-', '−');
  }
}
