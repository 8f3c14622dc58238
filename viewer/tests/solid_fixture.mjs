// A free cube of 2 × 2 × 2 elements that is stretched along x and coloured by its stress.
import { base64 } from './fixture.mjs';

const kNodes = [...Array(27)].map((_, n) => [
  (n % 3) - 1,
  (Math.floor(n / 3) % 3) - 1,
  Math.floor(n / 9) - 1,
]);
const node = (i, j, k) => i + 3 * (j + 3 * k);

/** The 24 faces of the surface with the element below each. */
function surface() {
  const faces = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const end of [0, 1]) {
      for (let a = 0; a < 2; a++) {
        for (let b = 0; b < 2; b++) {
          const at = (u, v) => {
            const p = [0, 0, 0];
            p[axis] = 2 * end;
            p[(axis + 1) % 3] = a + u;
            p[(axis + 2) % 3] = b + v;
            return node(...p);
          };
          const cell = [0, 0, 0];
          cell[axis] = end;
          cell[(axis + 1) % 3] = a;
          cell[(axis + 2) % 3] = b;
          const around = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
          faces.push({
            nodes: end ? around : around.reverse(),
            element: cell[0] + 2 * (cell[1] + 2 * cell[2]),
          });
        }
      }
    }
  }
  return faces;
}

export function solidCube() {
  const times = [...Array(50)].map((_, i) => i / 49);
  const faces = surface();
  return {
    format: 1,
    title: 'Stretched cube',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: times.length, f32: base64(times) },
    bodies: [
      {
        name: 'cube',
        kind: 'solid',
        nodes: kNodes,
        elements: [],
        radius: [],
        faces: faces.map((face) => face.nodes),
        faceElements: faces.map((face) => face.element),
        markers: [],
        pose: base64(times.flatMap((t) => [t, 0, 0, 1, 0, 0, 0])),
        displacement: base64(times.flatMap((t) => kNodes.flatMap(([x]) => [0.3 * t * x, 0, 0]))),
        stress: null,
        solidStress: base64(times.flatMap((t) => [1, 2, 3, 4, 5, 6, 7, 8].map((e) => e * t * 1e6))),
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
