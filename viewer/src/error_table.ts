import { figure } from './quantity';

type Tree = Record<string, unknown>;

/** One component of a sensor with its uncertainty. */
export interface ErrorRow {
  /** "tip.x" */
  name: string;
  /** Value of largest magnitude, and the last one: "0.01877 ± 1.2e−4 m". */
  peak: string;
  final: string;
  /** Where the uncertainty of the peak comes from: "time step 2.0e−5, mesh 9.8e−5". */
  split: string;
}

/** The error statement of `buckens run --error` on the sensors of a run. */
export interface ErrorTable {
  rows: ErrorRow[];
  /** Errors not included in the uncertainties, and other remarks; sentences. */
  notes: string[];
}

function isTree(value: unknown): value is Tree {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function numberOf(value: unknown): number {
  return typeof value === 'number' ? value : NaN;
}

function textsOf(value: unknown): string[] {
  return Array.isArray(value) ? value.filter((x): x is string => typeof x === 'string') : [];
}

/** As many digits of a value as its uncertainty justifies, and one more. */
export function certainDigits(value: number, uncertainty: number): string {
  if (!(uncertainty > 0) || value === 0) return figure(value);
  const digits = Math.ceil(Math.log10(Math.abs(value) / uncertainty)) + 1;
  return figure(value, Math.min(12, Math.max(2, digits)));
}

/** "0.01877 ± 1.2e−4 m"; "± at least" where a source of errors was not assessed. */
function stated(of: unknown, unit: string, isBound: boolean): string {
  const { value, uncertainty } = isTree(of) ? of : ({} as Tree);
  const [x, u] = [numberOf(value), numberOf(uncertainty)];
  if (!Number.isFinite(x)) return '';
  const bound = isBound ? 'at least ' : '';
  const off = Number.isFinite(u) ? ` ± ${bound}${figure(u, 2)}` : '';
  return `${certainDigits(x, u)}${off}${unit === '1' || !unit ? '' : ` ${unit}`}`;
}

function splitOf(of: unknown, sampling: number): string {
  const parts = isTree(of) && isTree(of.parts) ? of.parts : {};
  const known = Object.entries(parts).map(([source, part]) => [source, numberOf(part)] as const);
  const all = [...known, ['records', sampling] as const];
  return all
    .filter(([, part]) => part > 0)
    .map(([source, part]) => `${source} ${figure(part, 2)}`)
    .join(', ');
}

/** The error statement of a summary; null where the run was made without `--error`. */
export function errorTable(summary: Tree): ErrorTable | null {
  const { errors } = summary;
  if (!isTree(errors) || !isTree(errors.sensors)) return null;
  const missing = new Set<string>();
  const rows = Object.entries(errors.sensors).flatMap(([name, of]) => {
    if (!isTree(of)) return [];
    const unit = typeof of.unit === 'string' ? of.unit : '';
    const lacking = textsOf(of.not_assessed);
    for (const what of lacking) missing.add(what);
    const split = splitOf(of.peak, numberOf(of.sampling));
    return [
      {
        name,
        peak: stated(of.peak, unit, lacking.length > 0),
        final: stated(of.final, unit, lacking.length > 0),
        split: of.resolved === false ? `${split}; the curve is not resolved` : split,
      },
    ];
  });
  const notes = textsOf(errors.notes).map((note) => `Not assessed: ${note}`);
  if (missing.size > 0 && notes.length === 0) notes.push(`Not assessed: ${[...missing].join(', ')}`);
  if (errors.complete === false) notes.push('Interrupted before all further runs were made.');
  return { rows, notes };
}
