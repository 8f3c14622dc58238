// A ring of many faces that bends to and fro, to see how the page bears large meshes.
import { base64, coded, ints } from './encoding.mjs';

/** `around` × `across` quadrilaterals, two triangles each; radii 1 m and 0.3 m. */
export function largeTorus({ around, across, frames, tensor = false }) {
  const count = around * across;
  const nodes = new Float32Array(3 * count);
  const faces = new Int32Array(4 * count);
  const node = (i, j) => (i % around) * across + (j % across);
  for (let i = 0; i < around; i++) {
    for (let j = 0; j < across; j++) {
      const [u, v] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
      const r = 1 + 0.3 * Math.cos(v);
      const n = node(i, j);
      nodes.set([r * Math.cos(u), r * Math.sin(u), 0.3 * Math.sin(v)], 3 * n);
      faces.set([n, node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)], 4 * n);
    }
  }
  const times = [...Array(frames)].map((_, k) => (0.1 * k) / Math.max(1, frames - 1));
  const moved = new Float32Array(3 * count * frames);
  const mises = new Float32Array(count * frames);
  const stress = new Float32Array(tensor ? 6 * count * frames : 0);
  for (let k = 0; k < frames; k++) {
    const phase = Math.sin((2 * Math.PI * k) / Math.max(1, frames - 1));
    for (let n = 0; n < count; n++) {
      const [x, y, z] = nodes.subarray(3 * n, 3 * n + 3);
      const bend = 0.15 * phase * (x * x - y * y);
      moved.set([0.1 * phase * z, 0, bend], 3 * (k * count + n));
      mises[k * count + n] = 1e8 * Math.abs(phase) * (0.3 + Math.abs(x * y) + 0.5 * Math.abs(z));
      if (tensor) stress.set([1e8 * phase * x, 5e7 * y, 0, 2e7 * z, 0, 0], 6 * (k * count + n));
    }
  }
  const field = (name, components, values) => ({ name, unit: 'Pa', on: 'places', components, values });
  const xx = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx'];
  return {
    title: `Ring of ${2 * count} triangles`,
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: frames, f32: base64(times) },
    bodies: [
      {
        name: 'ring',
        kind: 'solid',
        nodes: base64(nodes),
        elements: [],
        radius: [],
        faces: ints(faces),
        faceElements: ints(new Int32Array(count).map((_, e) => e)),
        facePlaces: ints(faces),
        markers: [],
        pose: base64(times.flatMap(() => [0, 0, 0, 1, 0, 0, 0])),
        displacement: coded(moved, 3 * count),
        fields: [
          field('von_mises', [''], coded(mises, count)),
          ...(tensor ? [field('stress', xx, coded(stress, 6 * count))] : []),
        ],
      },
    ],
    joints: [],
    gravity: [0, 0, 0],
    planar: null,
    sensors: [],
    energies: [],
    summary: {},
    storage: { records: 10 * frames, rounded: true, notes: [] },
  };
}
