import { figure } from './quantity';

type Tree = Record<string, unknown>;

/** Related lines of the details. */
export interface SummaryGroup {
  title: string;
  rows: [string, string][];
}

/** Words for the keys of summary.json and modes.json; others are shown as spelt. */
const kWords: Record<string, string> = {
  program: 'Program',
  format: 'Format of the run directory',
  started: 'Started (UTC)',
  ended: 'Ended (UTC)',
  finished: 'Reached its end',
  end_time: 'Simulated time [s]',
  steps: 'Steps',
  setup_solves: 'Large solves before the first step',
  energy_error: 'Energy error, relative',
  redundant_constraints: 'Conditions of joints that others imply',
  dof: 'Nodal variables',
  dof_of_mesh: 'Nodal variables of the mesh',
  factorisations: 'Factorisations',
  solves: 'Large solves',
  recycled: 'Solves saved by combining earlier ones',
  coupling: 'Inertial coupling',
  spin_over_lowest_frequency: 'Spin over lowest natural frequency',
  largest_neglected_share: 'Largest share of neglected coupling terms',
  largest_rotation_rad: 'Largest rotation within the body [rad]',
  largest_strain: 'Largest strain',
  largest_axial_load_over_buckling_load: 'Largest axial load over buckling load',
  kept_modes: 'Vibration modes kept',
  static_shapes: 'Static shapes',
  highest_mode_hz: 'Highest mode kept [Hz]',
  controlled: 'Step chosen by the estimated error',
  rejected: 'Steps repeated because of their error',
  failed: 'Steps repeated because they did not converge',
  smallest: 'Smallest step [s]',
  largest: 'Largest step [s]',
  step: 'Step [s]',
  total: 'Total',
  setup: 'Set-up',
  stepping: 'Stepping',
  large_solves: 'of it large solves',
  newton: 'of it small Newton iterations',
  completion: 'of it completing the step',
  recording: 'of it recording',
  coupling_and_rest: 'of it coupling terms and the rest',
  per_step_mean: 'Mean per step',
  max: 'Most in a step',
  position: 'Position [m or rad]',
  velocity: 'Velocity [m/s or rad/s]',
  opening: 'Position, over the length of the model',
  opening_rate: 'Velocity, over the length of the model [1/s]',
  sieve: 'Rigid part of nodal variables, relative',
  steps_with_repeated_solve: 'Share of steps with a repeated solve',
  kind: 'Kind',
  body: 'Body',
  rigid_modes: 'Rigid modes',
  mass: 'Mass [kg]',
  frequency: 'Frequency [Hz]',
  omega_squared: 'Angular frequency squared [1/s²]',
  generalised_mass: 'Generalised mass [kg]',
  effective_mass: 'Effective mass x, y, z [kg]',
  error: 'Residual, relative',
  trust: 'Trust',
};

/** Groups by the keys of their path. */
const kGroups: Record<string, string> = {
  step_control: 'Time steps',
  'step_control.sizes': 'Step length',
  wall_seconds: 'Wall time [s]',
  'wall_seconds.phases': 'Wall time [s]',
  newton_iterations: 'Small Newton iterations',
  residuals: 'Largest violations of the joints',
  measures: 'Measures',
  energy_account: 'Energy account [J]',
  static_path: 'Static path',
  analyses: 'Vibrations',
  'analyses.modes': 'Mode',
  'analyses.modes.energy_shares': 'Mode',
};

/** Sides of the energy account. */
const kEnergySides: Record<string, string> = {
  brought_in: 'Energy brought in [J]',
  lost: 'Energy lost [J]',
  kept: 'Energy kept [J]',
};

/** Entries shown elsewhere on the page. */
const kShownElsewhere = [
  'title',
  'version',
  'status',
  'warnings',
  'notes',
  'interrupted',
  'errors',
];

function isTree(value: unknown): value is Tree {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** "largest_strain" as "Largest strain"; units at the end stay what they are. */
export function spelt(key: string): string {
  const text = key.replaceAll('_', ' ').trim();
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function words(path: string[]): string {
  const key = path.at(-1) ?? '';
  // Names of bodies are kept as the user wrote them.
  if (path.at(-2) === 'energy_shares') return `Share of the energy: ${key}`;
  if (path[0] === 'energy_account' && path.length === 4) {
    const kind = spelt(path[2]!.replaceAll('-', ' '));
    return key === 'model' ? kind : `${kind}: ${key}`;
  }
  return kWords[key] ?? spelt(key);
}

function groupOf(path: string[]): string {
  const numbers = path.filter((key) => /^\d+$/.test(key)).map((key) => Number(key) + 1);
  const way = path.filter((key) => !/^\d+$/.test(key));
  if (way[0] === 'bodies' && way.length > 1) return `Body ${path[1]!}`;
  if (way[0] === 'energy_account' && way.length > 1) return kEnergySides[way[1]!] ?? spelt(way[1]!);
  const title = kGroups[way.join('.')] ?? spelt(way.at(-1) ?? '');
  const number = numbers.join('.');
  return number ? `${title} ${number}` : title;
}

/** Values negligible beside the largest of a list are shown as zero. */
function listText(values: unknown[]): string {
  const sizes = values.map((x) => (typeof x === 'number' ? Math.abs(x) : 0));
  const least = 1e-12 * Math.max(...sizes);
  return values.map((x) => leafText(typeof x === 'number' && Math.abs(x) < least ? 0 : x)).join(', ');
}

function leafText(value: unknown): string {
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value === 'number') return Number.isInteger(value) ? String(value) : figure(value, 5);
  return String(value);
}

/** All figures of a summary with their names, grouped. */
export function summaryGroups(summary: Tree): SummaryGroup[] {
  const groups = new Map<string, SummaryGroup>();
  const add = (title: string, row: [string, string]) => {
    let group = groups.get(title);
    if (!group) groups.set(title, (group = { title, rows: [] }));
    group.rows.push(row);
  };
  const walk = (value: unknown, path: string[]) => {
    if (value === null || value === undefined) return;
    if (isTree(value)) {
      for (const [key, inner] of Object.entries(value)) {
        if (path.length === 0 && kShownElsewhere.includes(key)) continue;
        walk(inner, [...path, key]);
      }
    } else if (Array.isArray(value) && value.some(isTree)) {
      value.forEach((inner, i) => walk(inner, [...path, String(i)]));
    } else if (!Array.isArray(value) || value.length > 0) {
      const text = Array.isArray(value) ? listText(value) : leafText(value);
      add(path.length > 1 ? groupOf(path.slice(0, -1)) : 'Run', [words(path), text]);
    }
  };
  walk(summary, []);
  return [...groups.values()];
}
