// A free cube of 2 × 2 × 2 elements that is stretched along x and coloured by its stress.
import { base64, coded, ints, rows } from './encoding.mjs';

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

/** Stress xx of 4 MPa at x = +1 falling to zero at x = −1, with time; a shear that stays small. */
const stressAt = (t, [x, y]) => [2e6 * t * (1 + x), 0, 0, 1e5 * t * y, 0, 0];

/** Every node has one place, but those in the plane x = 0, y > 0, which were not recorded. */
const isRecorded = ([x, y]) => x !== 0 || y <= 0;

export function solidCube() {
  const times = [...Array(50)].map((_, i) => i / 49);
  const faces = surface();
  const recorded = kNodes.map((p, n) => ({ p, n })).filter(({ p }) => isRecorded(p));
  const placeOf = new Map(recorded.map(({ n }, place) => [n, place]));
  const places = (row) => times.flatMap((t) => recorded.flatMap(({ p }) => row(t, p)));
  const field = (name, unit, on, components, values, constant = false) => ({
    name,
    unit,
    on,
    components,
    values,
    constant,
  });
  const tensor = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx'];
  return {
    title: 'Stretched cube',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: times.length, f32: base64(times) },
    bodies: [
      {
        name: 'cube',
        kind: 'solid',
        nodes: base64(kNodes.flat()),
        nodeNumbers: ints(kNodes.map((_, n) => 100 + n)),
        elements: [],
        radius: [],
        faces: ints(faces.flatMap((face) => face.nodes)),
        faceElements: ints(faces.map((face) => face.element)),
        facePlaces: ints(faces.flatMap((face) => face.nodes.map((n) => placeOf.get(n) ?? -1))),
        markers: [],
        pose: base64(times.flatMap((t) => [t, 0, 0, 1, 0, 0, 0])),
        displacement: coded(times.flatMap((t) => kNodes.flatMap(([x]) => [0.3 * t * x, 0, 0])), 81),
        fields: [
          field('von_mises', 'Pa', 'elements', [''], rows(times.flatMap((t) => [1, 2, 3, 4, 5, 6, 7, 8].map((e) => e * t * 1e6)))),
          field('stress', 'Pa', 'places', tensor, coded(places(stressAt), 6 * recorded.length)),
          field('velocity', 'm/s', 'places', ['x', 'y', 'z'], rows(places((t, [x]) => [1 + 0.3 * x, 0, 0]))),
          field('von_mises_largest', 'Pa', 'places', [''], rows(recorded.map(({ p }) => 2e6 * (1 + p[0]))), true),
        ],
      },
    ],
    joints: [],
    loads: [
      {
        name: 'pull',
        kind: 'pressure',
        body: 0,
        follows: true,
        unit: 'Pa',
        positions: [[1, -0.5, -0.5], [1, 0.5, 0.5]],
        nodes: [-1, -1],
        directions: [[-1, 0, 0], [-1, 0, 0]],
        values: base64(times.map((t) => -4e6 * t)),
        width: 1,
      },
    ],
    gravity: [0, 0, 0],
    planar: null,
    sensors: [],
    energies: [],
    summary: {},
    storage: { records: 500, rounded: true, notes: [] },
  };
}
