// Reads the pictures that the browser takes: PNG with 8 bits of RGB or RGBA, not interlaced.
import { inflateSync } from 'node:zlib';

/** What a filter of PNG adds to a byte: its neighbours on the left, above, and above on the left. */
function predicted(filter, left, up, corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return up;
    case 3:
      return (left + up) >> 1;
    case 4: {
      const [a, b, c] = [Math.abs(up - corner), Math.abs(left - corner), Math.abs(left + up - 2 * corner)];
      return a <= b && a <= c ? left : b <= c ? up : corner;
    }
    default:
      return 0;
  }
}

/** Width, height and RGBA bytes row by row. */
export function decodePng(file) {
  const parts = [];
  let [width, height, channels] = [0, 0, 0];
  for (let at = 8; at < file.length; ) {
    const length = file.readUInt32BE(at);
    const kind = file.toString('latin1', at + 4, at + 8);
    const body = file.subarray(at + 8, at + 8 + length);
    if (kind === 'IHDR') {
      [width, height] = [body.readUInt32BE(0), body.readUInt32BE(4)];
      channels = { 2: 3, 6: 4 }[body[9]];
      if (body[8] !== 8 || !channels || body[12] !== 0) throw new Error('unexpected kind of PNG');
    }
    if (kind === 'IDAT') parts.push(body);
    at += length + 12;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const data = Buffer.alloc(4 * width * height, 255);
  const rows = [new Uint8Array(stride), new Uint8Array(stride)];
  for (let y = 0; y < height; y++) {
    const [above, row] = [rows[(y + 1) % 2], rows[y % 2]];
    const first = y * (stride + 1);
    const filter = raw[first];
    for (let i = 0; i < stride; i++) {
      const left = i < channels ? 0 : row[i - channels];
      const corner = i < channels ? 0 : above[i - channels];
      row[i] = raw[first + 1 + i] + predicted(filter, left, above[i], corner);
    }
    for (let x = 0; x < width; x++) {
      for (let k = 0; k < channels; k++) data[4 * (y * width + x) + k] = row[channels * x + k];
    }
  }
  return { width, height, data };
}
