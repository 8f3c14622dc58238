import { figure } from './quantity';
import type { Run } from './run';

export interface Chip {
  label: string;
  value: string;
  tone: 'plain' | 'good' | 'warn';
  title: string;
}

type Tree = Record<string, unknown>;

function isTree(value: unknown): value is Tree {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function at(tree: Tree, path: string): unknown {
  let value: unknown = tree;
  for (const key of path.split('.')) value = isTree(value) ? value[key] : undefined;
  return value;
}

function numberAt(tree: Tree, path: string): number | undefined {
  const value = at(tree, path);
  return typeof value === 'number' && Number.isFinite(value) ? value : undefined;
}

function texts(value: unknown): string[] {
  if (typeof value === 'string') return value ? [value] : [];
  if (Array.isArray(value)) return value.flatMap(texts);
  if (isTree(value)) return texts(value.reasons ?? value.message ?? value.text);
  return [];
}

function seconds(value: number): string {
  return value < 1 ? `${figure(1e3 * value, 3)} ms` : `${figure(value, 3)} s`;
}

/** Reasons not to trust the run; empty when the program called it ok. */
export function trustReasons(summary: Tree): string[] {
  const trust = summary.trust;
  if (trust === undefined || trust === null || trust === 'ok') return [];
  if (isTree(trust) && (trust.ok === true || trust.status === 'ok')) return [];
  return texts(trust).filter((reason) => reason !== 'ok');
}

/** Other messages of the program: warnings, redundant constraints, an interruption. */
export function notices(summary: Tree): string[] {
  const found = texts(summary.warnings);
  const interrupted = texts(summary.interrupted);
  if (interrupted.length) found.push(`Interrupted: ${interrupted.join(', ')}`);
  else if (summary.finished === false) found.push('The run did not reach its end.');
  if (summary.status === 'starting' || summary.status === 'running') {
    found.push('Written while the run was still going on, or after it was killed.');
  }
  return found;
}

function factorisations(summary: Tree): number | undefined {
  const bodies = summary.bodies;
  if (!isTree(bodies)) return undefined;
  const counts = Object.values(bodies)
    .map((body) => (isTree(body) ? body.factorisations : undefined))
    .filter((count): count is number => typeof count === 'number');
  return counts.length ? counts.reduce((a, b) => a + b, 0) : undefined;
}

/** The few figures in the header. */
export function summaryChips(run: Run): Chip[] {
  const chips: Chip[] = [];
  const { summary } = run;
  const add = (label: string, value: string, title: string, tone: Chip['tone'] = 'plain') =>
    chips.push({ label, value, title, tone });
  const steps = numberAt(summary, 'steps');
  const wall = numberAt(summary, 'wall_seconds.total');
  if (steps !== undefined) {
    const time = wall === undefined ? '' : ` in ${seconds(wall)}`;
    add('steps', `${steps}${time}`, 'Time steps and wall time of the whole run');
  }
  const factors = factorisations(summary);
  if (factors !== undefined) {
    add('factorisations', String(factors), 'Factorisations of body matrices, all bodies together');
  }
  const closure = numberAt(summary, 'residuals.position');
  if (closure !== undefined) {
    add('joint error', figure(closure, 2), 'Largest constraint residual on position level');
  }
  const energy = numberAt(summary, 'energy_error');
  if (energy !== undefined) {
    add('energy error', figure(energy, 2), 'Relative error of the energy balance');
  }
  if (summary.trust !== undefined && summary.trust !== null) {
    const reasons = trustReasons(summary);
    add(
      'trust',
      reasons.length ? 'see why' : 'ok',
      reasons.join('\n') || 'No check of the program objected',
      reasons.length ? 'warn' : 'good',
    );
  }
  if (run.storage.shown < run.storage.records) {
    const value = `${run.storage.shown} of ${run.storage.records}`;
    add('frames', value, 'Records of the run that are in this page');
  }
  const said = notices(summary);
  if (said.length) {
    const count = said.length === 1 ? '1 warning' : `${said.length} warnings`;
    add('', count, said.join('\n'), 'warn');
  }
  return chips;
}
