// Vibrations: three modes of a beam, one of them with a moving frame, one unstable.
import { base64, rows } from './encoding.mjs';

const kElements = 12;
const kLength = 0.8;

/** @param pitch factor of the frequencies */
export function vibrations(pitch = 1) {
  const nodes = [...Array(kElements + 1)].map((_, i) => [kLength * (i / kElements - 0.5), 0, 0]);
  const half = (x) => Math.sin(Math.PI * (x / kLength + 0.5));
  const slope = (x) => (Math.PI / kLength) * Math.cos(Math.PI * (x / kLength + 0.5));
  const bent = nodes.flatMap(([x]) => [0, half(x), 0, 0, 0, slope(x)]);
  const rigid = nodes.flatMap(() => [0, 0, 0, 0, 0, 0]);
  const stretched = nodes.flatMap(([x]) => [(2 * x) / kLength, 0, 0, 0, 0, 0]);
  const pose = [0.1, 0.2, 0, 1, 0, 0, 0];
  return {
    title: 'Vibrations of a beam',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: 3, f32: base64([1, 2, 3]) },
    bodies: [
      {
        name: 'beam',
        kind: 'beam',
        nodes: base64(nodes.flat()),
        elements: [...Array(kElements)].map((_, i) => [i, i + 1]),
        radius: Array(kElements).fill([0.01, 0.01]),
        markers: [],
        pose: base64([...pose, ...pose, ...pose]),
        displacement: rows([...bent, ...rigid, ...stretched]),
        motion: base64([0, 0, 0, 0, 0, 0, 0, 0, 0.4, 0, 1, 0, 0, 0, 0, 0, 0, 0]),
      },
    ],
    joints: [],
    gravity: [0, 0, 0],
    planar: null,
    sensors: [],
    energies: [],
    modes: [
      { label: 'beam 1', frequency: 53.2 * pitch, mass: 0.4 },
      { label: 'system 1', frequency: 1.25 * pitch, mass: 0.9 },
      { label: 'system 2', frequency: 0, mass: 0.3 },
    ],
    summary: { title: 'Vibrations of a beam', analyses: [{ kind: 'free', rigid_modes: 6 }] },
  };
}
