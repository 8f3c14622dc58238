// Numbers as the program writes them into a page.
const packed = (numbers, size, write) => {
  const bytes = Buffer.alloc(size * numbers.length);
  for (let i = 0; i < numbers.length; i++) bytes[write](numbers[i], size * i);
  return bytes.toString('base64');
};

export const base64 = (numbers) => packed(numbers, 4, 'writeFloatLE');
export const ints = (numbers) => packed(numbers, 4, 'writeInt32LE');
/** Rows of float32. */
export const rows = (numbers) => ({ type: 'f32', values: base64(numbers) });

/** Rows of `width` numbers as codes of 16 bits; NaN is missing. */
export function coded(numbers, width) {
  const codes = new Uint16Array(numbers.length);
  const ranges = [];
  for (let at = 0; at < numbers.length; at += width) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = at; i < at + width; i++) {
      if (numbers[i] < low) low = numbers[i];
      if (numbers[i] > high) high = numbers[i];
    }
    [low, high] = [Math.fround(low), Math.fround(high)];
    ranges.push(low, high);
    for (let i = at; i < at + width; i++) {
      const share = high > low ? (numbers[i] - low) / (high - low) : 0;
      codes[i] = Number.isNaN(numbers[i]) ? 65535 : Math.min(65534, Math.max(0, Math.round(65534 * share)));
    }
  }
  return { type: 'u16', values: Buffer.from(codes.buffer).toString('base64'), ranges: base64(ranges) };
}
