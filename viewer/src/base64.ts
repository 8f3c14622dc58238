/** Base64 (RFC 4648) of little-endian numbers, read from any position without decoding the rest. */

/** The page contains something that cannot be shown; the message says what and where. */
export class PageDataError extends Error {}

const kAlphabet = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
const kWrong = 255;
const kValue = new Uint8Array(256).fill(kWrong);
for (let i = 0; i < kAlphabet.length; i++) kValue[kAlphabet.charCodeAt(i)] = i;

/** Number of bytes that the text encodes. */
export function byteLength(text: string): number {
  const pads = text.endsWith('==') ? 2 : text.endsWith('=') ? 1 : 0;
  return (text.length / 4) * 3 - pads;
}

/** Bytes `from` … `from + count`. Throws PageDataError where the text is not base64. */
export function decodeBytes(text: string, from: number, count: number, where: string): Uint8Array {
  const first = Math.floor(from / 3);
  const groups = Math.ceil((from + count) / 3) - first;
  const bytes = new Uint8Array(3 * groups);
  let sum = 0;
  for (let g = 0, c = 4 * first, b = 0; g < groups; g++, c += 4, b += 3) {
    const [d1, d2] = [kValue[text.charCodeAt(c)]!, kValue[text.charCodeAt(c + 1)]!];
    let [d3, d4] = [kValue[text.charCodeAt(c + 2)]!, kValue[text.charCodeAt(c + 3)]!];
    if (c + 4 >= text.length) {
      const ends = text[c + 3] === '=';
      if (ends) d4 = 0;
      if (ends && text[c + 2] === '=') d3 = 0;
    }
    sum |= d1 | d2 | d3 | d4;
    bytes[b] = (d1 << 2) | (d2 >> 4);
    bytes[b + 1] = (d2 << 4) | (d3 >> 2);
    bytes[b + 2] = (d3 << 6) | d4;
  }
  if (sum > 63) throw new PageDataError(`${where}: not valid base64`);
  return bytes.subarray(from - 3 * first, from - 3 * first + count);
}

/** Checks that the text holds `count` numbers of `size` bytes. */
export function checkBase64(text: unknown, count: number, size: number, where: string): string {
  if (typeof text !== 'string') throw new PageDataError(`${where}: base64 text expected`);
  if (text.length % 4 !== 0) throw new PageDataError(`${where}: not valid base64`);
  const found = byteLength(text) / size;
  if (found !== count) {
    throw new PageDataError(`${where}: ${found} numbers found, ${count} expected`);
  }
  return text;
}

/** `bytes` as a separate array, so that it starts at a multiple of the number's size. */
function buffer(bytes: Uint8Array): ArrayBuffer {
  return bytes.slice().buffer as ArrayBuffer;
}

/** WebGL runs on little-endian machines only; there the bytes are the numbers already. */
export function floatsAt(text: string, from: number, count: number, where: string): Float32Array {
  return new Float32Array(buffer(decodeBytes(text, 4 * from, 4 * count, where)));
}

export function shortsAt(text: string, from: number, count: number, where: string): Uint16Array {
  return new Uint16Array(buffer(decodeBytes(text, 2 * from, 2 * count, where)));
}

/** Numbers of one field of float32. Throws PageDataError if the text or the count is wrong. */
export function decodeFloats(text: unknown, count: number, where: string): Float32Array {
  return floatsAt(checkBase64(text, count, 4, where), 0, count, where);
}

/** All whole numbers (int32) of a field whose count must be a multiple of `width`. */
export function decodeInts(text: unknown, width: number, where: string): Int32Array {
  const count = typeof text === 'string' ? byteLength(text) / 4 : 0;
  const checked = checkBase64(text, width * Math.floor(count / width), 4, where);
  return new Int32Array(buffer(decodeBytes(checked, 0, 4 * count, where)));
}
