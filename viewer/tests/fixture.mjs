// A synthetic run with the motion of a slider-crank, and pages made from it without the program.
//   node tests/fixture.mjs OUT.html [variant]      variants: see kVariants below
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { base64, coded, ints, rows } from './encoding.mjs';
import { chain, wavyChain } from './chain_fixture.mjs';
import { largeTorus } from './large_fixture.mjs';
import { vibrations } from './modes_fixture.mjs';
import { solidCube } from './solid_fixture.mjs';
import { rotor } from './rotor_fixture.mjs';
import { spatial } from './spatial_fixture.mjs';

export { base64, coded, ints, rows };

const kHere = dirname(fileURLToPath(import.meta.url));
const kMarker = '/*BUCKENS_DATA*/null';

const aboutZ = (angle) => [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)];
const kUpright = [1, 0, 0, 0];

/** Slider-crank of crank r and rod l with a rod that swings in its first bending shape. */
function crankState(t, { r, l, speed, bending }) {
  const phi = speed * t;
  const pin = [r * Math.cos(phi), r * Math.sin(phi), 0];
  const psi = -Math.asin((r * Math.sin(phi)) / l);
  const slider = pin[0] + l * Math.cos(psi);
  const mid = bending * 0.02 * l * Math.sin(phi) * (1 + 0.25 * Math.sin(6.3 * phi));
  return { phi, pin, psi, slider, mid };
}

function rodShape(nodes, l, mid) {
  return nodes.flatMap(([x]) => {
    const s = Math.PI * (x / l + 0.5);
    return [0, mid * Math.sin(s), 0, 0, 0, ((mid * Math.PI) / l) * Math.cos(s)];
  });
}

/** Bending moment of the sine at both ends of every element. */
function rodMoments(nodes, l, mid) {
  const at = ([x]) => [0, 0, 13 * mid * (Math.PI / l) ** 2 * Math.sin(Math.PI * (x / l + 0.5))];
  return nodes.slice(1).flatMap((node, i) => [...at(nodes[i]), ...at(node)]);
}

export function sliderCrank({ frames = 400, scale = 1, offset = [0, 0, 0], planar = 'xy', bending = 1 } = {}) {
  const [r, l, speed, duration, elements] = [0.15 * scale, 0.3 * scale, 150, 0.1, 12];
  const nodes = [...Array(elements + 1)].map((_, i) => [l * (i / elements - 0.5), 0, 0]);
  const times = [...Array(frames)].map((_, i) => (frames > 1 ? (duration * i) / (frames - 1) : 0));
  const states = times.map((t) => crankState(t, { r, l, speed, bending }));
  const place = (p) => p.map((x, i) => x + offset[i]);
  const marker = (name, x, node = -1) => ({
    name,
    position: [x, 0, 0],
    orientation: kUpright,
    node,
  });
  const side = (body, at, position) => ({ body, marker: at, position });
  const bodies = [
    {
      name: 'crank',
      kind: 'rigid',
      nodes: '',
      elements: [],
      radius: [],
      markers: [marker('base', -r / 2), marker('pin', r / 2)],
      pose: base64(states.flatMap((s) => [...place(s.pin.map((x) => x / 2)), ...aboutZ(s.phi)])),
      displacement: null,
    },
    {
      name: 'rod',
      kind: 'beam',
      nodes: base64(nodes.flat()),
      elements: [...Array(elements)].map((_, i) => [i, i + 1]),
      radius: Array(elements).fill([0.003 * scale, 0.003 * scale]),
      markers: [
        marker('start', -l / 2, 0),
        marker('mid', 0, elements / 2),
        marker('end', l / 2, elements),
      ],
      pose: base64(
        states.flatMap((s) => [
          ...place([(s.pin[0] + s.slider) / 2, s.pin[1] / 2, 0]),
          ...aboutZ(s.psi),
        ]),
      ),
      displacement: rows(states.flatMap((s) => rodShape(nodes, l, s.mid))),
      fields: [
        {
          name: 'von_mises',
          unit: 'Pa',
          components: [''],
          on: 'lines',
          values: rows(
        states.flatMap((s) =>
          nodes.slice(1).map(([x], i) => {
            const middle = (x + nodes[i][0]) / 2;
            const curvature = s.mid * (Math.PI / l) ** 2 * Math.sin(Math.PI * (middle / l + 0.5));
            return Math.abs(2e11 * 0.003 * scale * curvature);
          }),
        ),
          ),
        },
        {
          name: 'section_moment',
          unit: 'N m',
          components: ['Mt', 'My', 'Mz'],
          on: 'lineEnds',
          values: rows(states.flatMap((s) => rodMoments(nodes, l, s.mid))),
        },
      ],
    },
    {
      name: 'slider',
      kind: 'rigid',
      nodes: '',
      elements: [],
      radius: [],
      markers: [marker('origin', 0)],
      pose: base64(states.flatMap((s) => [...place([s.slider, 0, 0]), ...kUpright])),
      displacement: null,
    },
  ];
  const joint = (name, type, a, b, axis = [0, 0, 1]) => ({ name, type, between: [a, b], axis });
  const pinForce = (s) => [900 * Math.cos(s.phi), 650 * Math.sin(s.phi), 0];
  const ground = side(-1, -1, offset);
  const joints = [
    joint('base', 'revolute', ground, side(0, 0, [-r / 2, 0, 0])),
    joint('motor', 'prescribed-rotation', ground, side(0, 0, [-r / 2, 0, 0])),
    joint('pin', 'revolute', side(0, 1, [r / 2, 0, 0]), side(1, 0, [-l / 2, 0, 0])),
    joint('wrist', 'revolute', side(1, 2, [l / 2, 0, 0]), side(2, 0, [0, 0, 0])),
    joint('guide', 'prismatic', ground, side(2, 0, [0, 0, 0]), [1, 0, 0]),
  ];
  joints[2].force = base64(states.flatMap(pinForce));
  joints[1].torque = base64(states.flatMap((s) => [0, 0, 3 * Math.sin(2 * s.phi)]));
  const sensor = (name, unit, components, row) => ({
    name,
    unit,
    components,
    values: base64(states.flatMap(row)),
  });
  const kinetic = (s) => 20 + 8 * Math.cos(2 * s.phi);
  return {
    title: 'Flexible slider-crank',
    version: '0.1.0',
    generated: '2026-01-01T00:00:00Z',
    time: { n: frames, f32: base64(times) },
    bodies,
    joints,
    loads: [
      {
        name: 'push',
        kind: 'force',
        body: 2,
        follows: false,
        unit: 'N',
        positions: [[0, 0, 0]],
        nodes: [-1],
        directions: [],
        values: base64(states.flatMap((s) => [0, -200 * Math.cos(s.phi), 0])),
        width: 3,
      },
      {
        // On all bodies: it has no place of its own.
        name: 'shake',
        kind: 'base-acceleration',
        body: -1,
        follows: false,
        unit: 'm/s^2',
        positions: [],
        nodes: [],
        directions: [],
        values: base64(states.flatMap((s) => [Math.sin(s.phi), 0, 0])),
        width: 3,
      },
    ],
    gravity: [0, 0, 0],
    planar,
    sensors: [
      sensor('mid deflection', 'm', [''], (s) => [s.mid]),
      sensor('slider position', 'm', ['x', 'y', 'z'], (s) => place([s.slider, 0, 0])),
      sensor('motor torque', 'N m', [''], (s) => [3 * Math.sin(2 * s.phi)]),
      sensor('pin force', 'N', ['x', 'y', 'z'], pinForce),
    ],
    energies: [
      { name: 'kinetic', unit: 'J', values: base64(states.map(kinetic)) },
      { name: 'strain', unit: 'J', values: base64(states.map((s) => 5e4 * (s.mid / scale) ** 2)) },
    ],
    summary: {
      version: '0.1.0',
      title: 'Flexible slider-crank',
      finished: true,
      end_time: duration,
      steps: 1000,
      wall_seconds: { total: 0.412, setup: 0.021, stepping: 0.391 },
      bodies: {
        crank: { dof: 6, factorisations: 0, solves: 0 },
        rod: { dof: 39, factorisations: 1, solves: 1014 },
        slider: { dof: 6, factorisations: 0, solves: 0 },
      },
      setup_solves: 14,
      newton_iterations: { total: 2300, per_step_mean: 2.3, max: 3 },
      residuals: { position: 3.1e-14, velocity: 2.2e-12, sieve: 1.8e-15 },
      energy_error: 4.3e-5,
      trust: 'ok',
      warnings: [],
      redundant: [],
    },
  };
}

export const kVariants = {
  'slider-crank': () => sliderCrank(),
  'slider-crank-3d': () => sliderCrank({ planar: null }),
  tiny: () => sliderCrank({ scale: 0.001 }),
  far: () => sliderCrank({ offset: [2000, -500, 100], planar: null }),
  'one-frame': () => sliderCrank({ frames: 1 }),
  'two-frames': () => sliderCrank({ frames: 2 }),
  'no-frames': () => sliderCrank({ frames: 0 }),
  'no-bodies': () => ({ ...sliderCrank(), bodies: [], joints: [], loads: [] }),
  'no-curves': () => ({ ...sliderCrank(), sensors: [], energies: [], summary: {} }),
  empty: () => null,
  broken: () => ({ ...sliderCrank(), time: { n: 7, f32: base64([1, 2]) } }),
  spatial,
  modes: () => vibrations(),
  'modes-side-by-side': () => [vibrations(), vibrations(0.5)],
  solid: () => solidCube(),
  'side-by-side': () => [
    { ...sliderCrank(), directory: 'once' },
    { ...sliderCrank({ frames: 250, bending: 2 }), directory: 'twice', changes: ['rod.bending=2'] },
  ],
  rotor,
  crowd: () => chain(3000),
  'long-chain': () => wavyChain(10000),
  large: () => largeTorus({ around: 200, across: 50, frames: 6 }),
};

/** The built page (BUCKENS_VIEWER_PAGE, else viewer/dist) with `data` in it, as the program writes it. */
const kTemplate = process.env.BUCKENS_VIEWER_PAGE ?? join(kHere, '../dist/index.html');
export function pageWith(data, template = kTemplate) {
  const html = readFileSync(template, 'utf8');
  const parts = html.split(kMarker);
  if (parts.length !== 2)
    throw new Error(`${template}: ${parts.length - 1} data markers, 1 expected`);
  // No "<" reaches the page, so no text in a model can end the script element.
  const page = data && { format: 2, runs: Array.isArray(data) ? data : [data] };
  return parts.join(JSON.stringify(page).replaceAll('<', '\\u003c'));
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  const [out, variant = 'slider-crank'] = process.argv.slice(2);
  if (!out || !kVariants[variant]) {
    console.error(`usage: fixture.mjs OUT.html [${Object.keys(kVariants).join('|')}]`);
    process.exit(2);
  }
  writeFileSync(out, pageWith(kVariants[variant]()));
}
