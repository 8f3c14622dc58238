// What turns about an axis around which it is round: a shaft of beams and a rigid hub.
import { base64, ints, rows } from './encoding.mjs';

const kUpright = [1, 0, 0, 0];
const kFrames = 100;

/** A circle of 24 corners, as the program writes it. */
const circle = (radius) =>
  base64([...Array(24)].flatMap((_, k) => [Math.cos, Math.sin].map((f) => radius * f((k * Math.PI) / 12))));

export function rotor() {
  const times = [...Array(kFrames)].map((_, i) => i / (kFrames - 1));
  const turned = times.map((t) => [Math.cos(3 * t), Math.sin(3 * t), 0, 0]);
  const nodes = [-0.5, 0, 0.5].flatMap((x) => [x, 0, 0]);
  return {
    title: 'Rotor',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: kFrames, f32: base64(times) },
    bodies: [
      {
        name: 'shaft',
        kind: 'beam',
        nodes: base64(nodes),
        elements: [[0, 1], [1, 2]],
        radius: [[0.1, 0.1], [0.1, 0.1]],
        sections: [[circle(0.1)]],
        elementSections: ints([0, 0, 0, 0]),
        elementAxes: base64([0, 1, 0, 0, 1, 0]),
        markers: [],
        pose: base64(turned.flatMap((q) => [0, 0, 0, ...q])),
        displacement: rows(times.flatMap(() => new Array(18).fill(0))),
      },
      {
        name: 'hub',
        kind: 'rigid',
        nodes: '',
        elements: [],
        radius: [],
        markers: [-0.3, 0.3].map((x, i) => ({
          name: `m${i}`,
          position: [x, 0, 0],
          orientation: kUpright,
          node: -1,
        })),
        pose: base64(turned.flatMap((q) => [0, 0.6, 0, ...q])),
        displacement: null,
      },
    ],
    joints: [],
    gravity: [0, 0, 0],
    planar: null,
    sensors: [],
    energies: [],
    summary: {},
  };
}
