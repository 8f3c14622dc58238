import { checkBase64, decodeFloats, floatsAt, PageDataError, shortsAt } from './base64';
import { locate, type FramePlace } from './interpolation';
import type { PageRows } from './page_data';

/** A quantity with one row of numbers per frame. NaN marks numbers that were not recorded. */
export interface Rows {
  readonly width: number;
  readonly frames: number;
  /** The row at a place between frames, interpolated linearly. */
  interpolate(place: FramePlace, out: Float32Array): void;
  /** One number of one frame. */
  value(frame: number, index: number): number;
  /** Least and largest number of a frame; [NaN, NaN] if there is none. */
  range(frame: number): [number, number];
}

/** Codes 0 … 65534 cover the range of their row; this one marks a missing number. */
export const kMissing = 65535;
const kSteps = 65534;

/** Numbers already decoded; float32, or 16-bit codes with a range per row. */
type Row = Float32Array | Uint16Array;

function mixCodes(
  a: Uint16Array,
  b: Uint16Array,
  low: number,
  ka: number,
  kb: number,
  out: Float32Array,
): void {
  for (let i = 0; i < a.length; i++) {
    const x = a[i]!;
    const y = b[i]!;
    out[i] = x === kMissing || y === kMissing ? NaN : low + ka * x + kb * y;
  }
}

function mixFloats(
  a: Float32Array,
  b: Float32Array,
  ka: number,
  kb: number,
  out: Float32Array,
): void {
  for (let i = 0; i < a.length; i++) out[i] = ka * a[i]! + kb * b[i]!;
}

/** Rows in base64; each is decoded when it is first used. */
export class PackedRows implements Rows {
  readonly width: number;
  private readonly text: string;
  private readonly coded: boolean;
  private readonly ranges: Float32Array | null;
  private readonly rows: (Row | undefined)[];

  /** Throws PageDataError if there are not `frames` rows of `width` numbers. */
  constructor(
    data: PageRows,
    width: number,
    readonly frames: number,
    private readonly where: string,
  ) {
    this.width = width;
    this.coded = data.type === 'u16';
    if (!this.coded && data.type !== 'f32') throw new PageDataError(`${where}: unknown type`);
    this.text = checkBase64(data.values, width * frames, this.coded ? 2 : 4, where);
    this.ranges = this.coded ? decodeFloats(data.ranges, 2 * frames, `${where}.ranges`) : null;
    this.rows = new Array<Row | undefined>(frames);
  }

  private row(frame: number): Row {
    const read = this.coded ? shortsAt : floatsAt;
    return (this.rows[frame] ??= read(this.text, frame * this.width, this.width, this.where));
  }

  /** Value of code 0 and of one step between codes; of plain numbers 0 and 1. */
  private scale(frame: number): [number, number] {
    if (!this.ranges) return [0, 1];
    const low = this.ranges[2 * frame]!;
    return [low, (this.ranges[2 * frame + 1]! - low) / kSteps];
  }

  interpolate({ index, fraction }: FramePlace, out: Float32Array): void {
    const first = Math.min(index, this.frames - 1);
    const second = fraction === 0 ? first : Math.min(first + 1, this.frames - 1);
    const [lowA, stepA] = this.scale(first);
    const [lowB, stepB] = this.scale(second);
    const low = (1 - fraction) * lowA + fraction * lowB;
    const [ka, kb] = [(1 - fraction) * stepA, fraction * stepB];
    const [a, b] = [this.row(first), this.row(second)];
    // Two loops for two kinds of arrays: either is compiled for its own.
    if (this.coded) mixCodes(a as Uint16Array, b as Uint16Array, low, ka, kb, out);
    else mixFloats(a as Float32Array, b as Float32Array, ka, kb, out);
  }

  /** Least difference between the numbers of a frame; 0 for float32. */
  grain(frame: number): number {
    return this.ranges ? this.scale(frame)[1] : 0;
  }

  value(frame: number, index: number): number {
    const at = Math.min(frame, this.frames - 1);
    const known = this.rows[at];
    const place = at * this.width + index;
    const read = this.coded ? shortsAt : floatsAt;
    const raw = known ? known[index]! : read(this.text, place, 1, this.where)[0]!;
    if (this.coded && raw === kMissing) return NaN;
    const [low, step] = this.scale(at);
    return low + step * raw;
  }

  range(frame: number): [number, number] {
    if (this.ranges) return [this.ranges[2 * frame]!, this.ranges[2 * frame + 1]!];
    return rangeOf(this.row(frame));
  }
}

/** Least and largest finite number. */
export function rangeOf(values: ArrayLike<number>): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < values.length; i++) {
    const value = values[i]!;
    if (value < low) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return low <= high ? [low, high] : [NaN, NaN];
}

/** Rows at some frames only; between them values are interpolated linearly over the frames. */
export class SparseRows implements Rows {
  /** `at` holds the frame of each row, increasing. */
  constructor(
    private readonly rows: Rows,
    private readonly at: Int32Array,
    readonly frames: number,
  ) {}

  get width(): number {
    return this.rows.width;
  }

  /** Position among the rows for a position among the frames. */
  private place(frame: number): FramePlace {
    return locate(this.at, frame);
  }

  interpolate({ index, fraction }: FramePlace, out: Float32Array): void {
    this.rows.interpolate(this.place(index + fraction), out);
  }

  value(frame: number, index: number): number {
    const { index: row, fraction } = this.place(frame);
    const now = this.rows.value(row, index);
    return fraction === 0 ? now : (1 - fraction) * now + fraction * this.rows.value(row + 1, index);
  }

  range(frame: number): [number, number] {
    const { index, fraction } = this.place(frame);
    const [low, high] = this.rows.range(index);
    if (fraction === 0) return [low, high];
    const [nextLow, nextHigh] = this.rows.range(index + 1);
    return [Math.min(low, nextLow), Math.max(high, nextHigh)];
  }
}

/** The first rows; where they have no number, the second. */
export class MergedRows implements Rows {
  readonly width: number;
  readonly frames: number;
  private readonly row: Float32Array;

  constructor(
    private readonly first: Rows,
    private readonly second: Rows,
  ) {
    this.width = first.width;
    this.frames = Math.max(first.frames, second.frames);
    this.row = new Float32Array(first.width);
  }

  interpolate(place: FramePlace, out: Float32Array): void {
    this.first.interpolate(place, out);
    this.second.interpolate(place, this.row);
    for (let i = 0; i < this.width; i++) if (Number.isNaN(out[i]!)) out[i] = this.row[i]!;
  }

  value(frame: number, index: number): number {
    const value = this.first.value(frame, index);
    return Number.isNaN(value) ? this.second.value(frame, index) : value;
  }

  range(frame: number): [number, number] {
    const row = new Float32Array(this.width);
    this.interpolate({ index: frame, fraction: 0 }, row);
    return rangeOf(row);
  }
}

/** One oscillating shape: row k is the shape times `factors[k]`. */
export class SwingingRows implements Rows {
  private readonly shape: Float32Array;

  constructor(
    private readonly shapes: Rows,
    private readonly factors: Float64Array,
  ) {
    this.shape = new Float32Array(shapes.width);
  }

  get width(): number {
    return this.shapes.width;
  }

  get frames(): number {
    return this.factors.length;
  }

  /** Selects row `index` of the shapes. */
  choose(index: number): void {
    this.shapes.interpolate({ index, fraction: 0 }, this.shape);
  }

  interpolate({ index, fraction }: FramePlace, out: Float32Array): void {
    const next = this.factors[Math.min(index + 1, this.frames - 1)]!;
    const factor = (1 - fraction) * this.factors[index]! + fraction * next;
    for (let i = 0; i < this.width; i++) out[i] = factor * this.shape[i]!;
  }

  value(frame: number, index: number): number {
    return this.factors[frame]! * this.shape[index]!;
  }

  range(frame: number): [number, number] {
    const [low, high] = rangeOf(this.shape);
    const ends = [low, high].map((x) => x * this.factors[frame]!);
    return [Math.min(...ends), Math.max(...ends)];
  }
}
