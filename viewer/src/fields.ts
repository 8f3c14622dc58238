import { MergedRows, type Rows } from './rows';
import type { Body, Field, Run } from './run';

/** Something that can be shown in colour. */
export interface FieldItem {
  id: string;
  /** Items of one group are listed together. */
  group: string;
  label: string;
  unit: string;
}

/** How the numbers at one place are combined into one. */
export type Reduction =
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

/** Quantities derived from a stress tensor; the ids are those of recorded fields. */
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

/** All fields of a body, recorded quantities before derived ones. */
export function sourcesOf(body: Body): FieldSource[] {
  const all = body.fields.filter(({ name }) => name !== 'displacement').flatMap(fieldSources);
  if (body.shape) {
    all.push(...vectorSources('relative_displacement', '', 'nodes', body.shape, 3));
  } else if (body.displacement) {
    all.push(...vectorSources('displacement', 'm', 'nodes', body.displacement, body.perNode));
  }
  // A recorded "von Mises" field comes before the one computed from the tensor.
  const rank = ({ reduction: { kind } }: FieldSource) => (kind === 'mises' || kind === 'principal' ? 1 : 0);
  return merged(all.sort((a, b) => rank(a) - rank(b)));
}

/** Solids and shells of one body record the same quantity separately: one source of both. */
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

/** The list of all fields, each item once. */
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
