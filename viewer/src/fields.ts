import { MergedRows, rangeOf, type Rows } from './rows';
import type { Body, Field, Run } from './run';
import { magnitude, misesOf, planeMisesOf, principalOf } from './tensor';
import type { FramePlace } from './interpolation';

/** Something that can be shown in colour. */
export interface FieldItem {
  id: string;
  /** Items of one group stand together in the list. */
  group: string;
  label: string;
  unit: string;
}

/** How the numbers of one place become one. */
type Reduction =
  | { kind: 'pick'; component: number }
  | { kind: 'magnitude' }
  | { kind: 'mises' }
  | { kind: 'planeMises' }
  | { kind: 'principal'; component: number };

/** Where a body has the values of an item. */
export interface FieldSource {
  on: 'nodes' | Field['on'];
  rows: Rows;
  /** Numbers per place. */
  stride: number;
  reduction: Reduction;
  item: FieldItem;
}

const kLabels: Record<string, string> = {
  von_mises: 'von Mises stress',
  axial_stress: 'Axial stress',
  strain_energy_density: 'Strain-energy density',
  principal_stress: 'Principal stress',
  von_mises_largest: 'von Mises stress, largest of the run',
  von_mises_time: 'von Mises stress, time of the largest',
};

/** Names of section forces of beams, and of forces per length of shells, by component. */
const kForces: Record<string, { group: string; text: Record<string, string> }> = {
  section_force: {
    group: 'Section forces',
    text: { N: 'Normal force N', Qy: 'Shear force Qy', Qz: 'Shear force Qz' },
  },
  section_moment: {
    group: 'Section forces',
    text: { Mt: 'Torque Mt', My: 'Bending moment My', Mz: 'Bending moment Mz' },
  },
  shell_force: { group: 'Shells', text: {} },
  shell_moment: { group: 'Shells', text: {} },
  shell_shear_force: { group: 'Shells', text: {} },
};

function label(name: string): string {
  const text = kLabels[name] ?? name.replaceAll('_', ' ');
  return kLabels[name] ? text : text.charAt(0).toUpperCase() + text.slice(1);
}

function source(
  on: FieldSource['on'],
  rows: Rows,
  stride: number,
  reduction: Reduction,
  item: FieldItem,
): FieldSource {
  return { on, rows, stride, reduction, item };
}

const pick = (component: number): Reduction => ({ kind: 'pick', component });

/** Magnitude and components of a vector. */
function vectorSources(
  name: string,
  unit: string,
  on: FieldSource['on'],
  rows: Rows,
  stride: number,
): FieldSource[] {
  const group = label(name);
  const relative = name === 'relative_displacement';
  const text = relative ? group : `${group}, magnitude`;
  const whole = { id: `${name}/magnitude`, group, label: text, unit };
  return [
    source(on, rows, stride, { kind: 'magnitude' }, whole),
    ...['x', 'y', 'z'].map((axis, k) => {
      const item = { id: `${name}/${axis}`, group, label: `${group} ${axis}`, unit };
      return source(on, rows, stride, pick(k), item);
    }),
  ];
}

/** What a stress tensor gives besides its components; the ids are those of recorded fields. */
function stressInvariants(field: Field): FieldSource[] {
  const { on, rows, unit } = field;
  const mises = { id: 'von_mises', group: 'Stress', label: label('von_mises'), unit };
  return [
    source(on, rows, 6, { kind: 'mises' }, mises),
    ...[0, 1, 2].map((component) =>
      source(on, rows, 6, { kind: 'principal', component }, principalItem(component, unit)),
    ),
  ];
}

function principalItem(component: number, unit: string): FieldItem {
  const which = ['1 (largest)', '2', '3 (smallest)'][component]!;
  return {
    id: `principal_stress/${component + 1}`,
    group: 'Principal stress',
    label: `Principal stress ${which}`,
    unit,
  };
}

/** Stresses on one side of a shell or of one of its layers. */
function levelSources({ name, unit, level, components, on, rows }: Field): FieldSource[] {
  const group = `Shells, ${level}`;
  const item = (part: string, text: string) => ({
    id: `${name}/${level}/${part}`,
    group,
    label: `${text}, ${level}`,
    unit,
  });
  return [
    source(on, rows, 3, { kind: 'planeMises' }, item('von_mises', 'Shell von Mises stress')),
    ...components.map((c, k) => source(on, rows, 3, pick(k), item(c, `Shell stress ${c}`))),
  ];
}

function forceSources({ name, unit, components, on, rows }: Field): FieldSource[] {
  const { group, text } = kForces[name]!;
  return components.map((c, k) => {
    const item = { id: `${name}/${c}`, group, label: text[c] ?? `${label(name)} ${c}`, unit };
    return source(on, rows, components.length, pick(k), item);
  });
}

function fieldSources(field: Field): FieldSource[] {
  if (field.level && field.components.length === 3) return levelSources(field);
  if (kForces[field.name]) return forceSources(field);
  const { name, unit, components, on, rows } = field;
  const stride = components.length;
  if (stride === 1) {
    const group = unit === 'Pa' || name.startsWith('von_mises') ? 'Stress' : 'Other';
    return [source(on, rows, 1, pick(0), { id: name, group, label: label(name), unit })];
  }
  if (stride === 3 && components[0] === 'x') return vectorSources(name, unit, on, rows, 3);
  if (name === 'principal_stress' && stride === 3) {
    return [0, 1, 2].map((c) => source(on, rows, 3, pick(c), principalItem(c, unit)));
  }
  const group = `${label(name)} components`;
  const single = components.map((component, c) => {
    const item = { id: `${name}/${component}`, group, label: `${label(name)} ${component}`, unit };
    return source(on, rows, stride, pick(c), item);
  });
  const tensor = stride === 6 && components[0] === 'xx';
  return tensor && name === 'stress' ? [...stressInvariants(field), ...single] : single;
}

/** Everything that a body can show, recorded quantities before derived ones. */
export function sourcesOf(body: Body): FieldSource[] {
  const all = body.fields.filter(({ name }) => name !== 'displacement').flatMap(fieldSources);
  if (body.shape) {
    all.push(...vectorSources('relative_displacement', '', 'nodes', body.shape, 3));
  } else if (body.displacement) {
    all.push(...vectorSources('displacement', 'm', 'nodes', body.displacement, body.perNode));
  }
  // "von Mises" of a recorded field stands before the one worked out from the tensor.
  const rank = ({ reduction: { kind } }: FieldSource) => (kind === 'mises' || kind === 'principal' ? 1 : 0);
  return merged(all.sort((a, b) => rank(a) - rank(b)));
}

/** Solids and shells of one body record the same quantity each for themselves: one source of both. */
function merged(all: FieldSource[]): FieldSource[] {
  const known = new Map<string, FieldSource>();
  for (const of of all) {
    const key = `${of.item.id} ${of.on}`;
    const first = known.get(key);
    const alike = first && first.stride === of.stride && first.rows.width === of.rows.width;
    if (!first) known.set(key, of);
    else if (alike) known.set(key, { ...first, rows: new MergedRows(first.rows, of.rows) });
  }
  return [...known.values()];
}

const kGroupOrder = [
  'Stress',
  'Principal stress',
  'Section forces',
  'Displacement',
  'Velocity',
  'Acceleration',
];

/** The list of what can be shown, each item once. */
export function fieldItems(runs: Run[]): FieldItem[] {
  const items = new Map<string, FieldItem>();
  for (const run of runs) {
    for (const body of run.bodies) {
      for (const { item } of sourcesOf(body)) if (!items.has(item.id)) items.set(item.id, item);
    }
  }
  const rank = ({ group }: FieldItem) => (kGroupOrder.indexOf(group) + 1 || kGroupOrder.length + 1);
  return [...items.values()].sort((a, b) => rank(a) - rank(b));
}

/** Number of places at which a source has a value. */
export function numPlaces({ rows, stride }: FieldSource): number {
  return rows.width / stride;
}

function reduce(reduction: Reduction, row: ArrayLike<number>, at: number): number {
  switch (reduction.kind) {
    case 'pick':
      return row[at + reduction.component]!;
    case 'magnitude':
      return magnitude(row, at);
    case 'mises':
      return misesOf(row, at);
    case 'planeMises':
      return planeMisesOf(row, at);
    case 'principal':
      return principalOf(row, at, reduction.component);
  }
}

/** Works out the values of one source; keeps its memory from frame to frame. */
export class FieldValues {
  readonly values: Float32Array;
  private readonly row: Float32Array;

  constructor(readonly source: FieldSource) {
    this.values = new Float32Array(numPlaces(source));
    const same = source.stride === 1 && source.reduction.kind === 'pick';
    this.row = same ? this.values : new Float32Array(source.rows.width);
  }

  at(place: FramePlace): Float32Array {
    const { rows, stride, reduction } = this.source;
    rows.interpolate(place, this.row);
    if (this.row === this.values) return this.values;
    for (let i = 0; i < this.values.length; i++) {
      this.values[i] = reduce(reduction, this.row, stride * i);
    }
    return this.values;
  }
}

/** Value of a source at one of its places in every frame. */
export function history(of: FieldSource, index: number, frames: number): Float32Array {
  const out = new Float32Array(frames);
  const row = new Float32Array(of.stride);
  for (let frame = 0; frame < frames; frame++) {
    for (let k = 0; k < of.stride; k++) row[k] = of.rows.value(frame, of.stride * index + k);
    out[frame] = reduce(of.reduction, row, 0);
  }
  return out;
}

/** Least and largest value of an item in all frames; [0, 0] if it has none. */
export function rangeOfRun(runs: Run[], id: string): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const body of runs.flatMap((run) => run.bodies)) {
    for (const of of sourcesOf(body).filter(({ item }) => item.id === id)) {
      const single = of.stride === 1 && of.reduction.kind === 'pick';
      const values = single ? null : new FieldValues(of);
      for (let index = 0; index < of.rows.frames; index++) {
        const [a, b] = values ? rangeOf(values.at({ index, fraction: 0 })) : of.rows.range(index);
        if (a < low) low = a;
        if (b > high) high = b;
      }
    }
  }
  return low <= high ? [low, high] : [0, 0];
}

/** What the value of a body is asked at. */
export interface FieldPoint {
  node: number;
  /** −1 where the point has none of them. */
  place: number;
  element: number;
  line: number;
  /** Of the line: 0 or 1. */
  end: number;
}

/** Index of a point among the places of a source, −1 if it is none of them. */
export function indexAt(of: FieldSource, point: FieldPoint): number {
  const { node, place, element, line, end } = point;
  const lineEnds = line < 0 ? -1 : 2 * line + end;
  return { nodes: node, places: place, elements: element, lines: line, lineEnds }[of.on];
}

/** Which end of a line a node is. */
export function endOf(body: Body, line: number, node: number): number {
  return line >= 0 && body.elements[line]![1] === node ? 1 : 0;
}

/** Any way to a node's element and place, for nodes chosen by number. */
export function pointOf(body: Body, node: number): FieldPoint {
  const corner = body.faces ? body.faces.nodes.indexOf(node) : -1;
  const line = body.elements.findIndex((ends) => ends.includes(node));
  return {
    node,
    place: corner < 0 ? -1 : (body.faces!.places?.[corner] ?? -1),
    element: corner < 0 ? -1 : body.faces!.elements[corner >> 2]!,
    line,
    end: endOf(body, line, node),
  };
}
