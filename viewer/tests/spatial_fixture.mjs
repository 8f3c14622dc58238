// Two rigid bodies in space, with warnings and a title that would break a careless page.
import { base64 } from './encoding.mjs';

const kUpright = [1, 0, 0, 0];

/** A tumbling body without markers beside a falling pendulum, in space, with gravity along −z. */
export function spatial() {
  const frames = 200;
  const times = [...Array(frames)].map((_, i) => (2 * i) / (frames - 1));
  const tilt = (angle) => [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0];
  const swing = (t) => 1.2 * Math.cos(3.1 * t);
  const aboutX = (angle) => [Math.cos(angle / 2), Math.sin(angle / 2), 0, 0];
  return {
    title: 'Pendulum and spinning body </script> "&',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: frames, f32: base64(times) },
    bodies: [
      {
        name: 'pendulum',
        kind: 'rigid',
        nodes: '',
        elements: [],
        radius: [],
        markers: [
          { name: 'hinge', position: [0, 0, 0.5], orientation: kUpright, node: -1 },
          { name: 'tip', position: [0, 0, -0.5], orientation: kUpright, node: -1 },
        ],
        pose: base64(
          times.flatMap((t) => [
            -0.5 * Math.sin(swing(t)),
            0,
            -0.5 * Math.cos(swing(t)),
            ...tilt(swing(t)),
          ]),
        ),
        displacement: null,
      },
      {
        name: 'spinner',
        kind: 'rigid',
        nodes: '',
        elements: [],
        radius: [],
        markers: [],
        pose: base64(times.flatMap((t) => [0.6, 0.6, -0.3, ...aboutX(3 * t)])),
        displacement: null,
      },
    ],
    joints: [
      {
        name: 'hinge',
        type: 'revolute',
        axis: [0, 1, 0],
        between: [
          { body: -1, marker: -1, position: [0, 0, 0] },
          { body: 0, marker: 0, position: [0, 0, 0.5] },
        ],
      },
      {
        name: 'tether',
        type: 'spring-damper',
        axis: [0, 0, 1],
        between: [
          { body: 0, marker: 1, position: [0, 0, -0.5] },
          { body: 1, marker: -1, position: [0, 0, 0] },
        ],
      },
    ],
    loads: [
      {
        name: 'shake',
        kind: 'base-acceleration',
        body: -1,
        follows: false,
        unit: 'm/s^2',
        positions: [],
        nodes: [],
        directions: [],
        values: null,
        width: 0,
      },
    ],
    gravity: [0, 0, -9.81],
    planar: null,
    sensors: [
      {
        name: 'tip',
        unit: 'm',
        components: ['x', 'y', 'z'],
        values: base64(times.flatMap((t) => [-Math.sin(swing(t)), 0, -Math.cos(swing(t))])),
      },
    ],
    energies: [],
    summary: {
      steps: 2000,
      finished: false,
      trust: ['step too large for the highest mode'],
      warnings: ['body spinner: no connection to any other body'],
    },
  };
}
