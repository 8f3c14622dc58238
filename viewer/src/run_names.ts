import { kRunNames } from './charts';
import type { Run } from './run';

/** Overrides of one run but not of the other. */
function ownChanges(run: Run, other: Run): string {
  const own = run.changes.filter((change) => !other.changes.includes(change));
  // The last name of the path is enough: "elements=32".
  return own.map((change) => change.replace(/^[^=]*\.(?=[^=.]+=)/, '')).join(', ');
}

/** What distinguishes a run from another of the same title: its directory and overrides. */
export function difference(run: Run, other: Run): string {
  const set = ownChanges(run, other);
  const where = run.directory === other.directory ? '' : run.directory;
  return [where, set].filter(Boolean).join(' · ');
}

/** Names of runs side by side: title, or, if titles are equal, what distinguishes the runs. */
export function namesOfRuns(runs: Run[]): string[] {
  if (runs.length < 2) return runs.map((run) => run.title);
  const equal = runs[0]!.title === runs[1]!.title;
  return runs.map((run, i) => {
    const name = equal ? difference(run, runs[1 - i]!) || run.title : run.title;
    return `${kRunNames[i]!}: ${name}`;
  });
}

/** Title of the page. */
export function titleOf(runs: Run[]): string {
  if (runs.length < 2) return runs[0]?.title ?? '';
  const [a, b] = [runs[0]!, runs[1]!];
  if (a.title !== b.title) return `${a.title} | ${b.title}`;
  const names = namesOfRuns(runs);
  return difference(a, b) || difference(b, a) ? `${a.title} – ${names.join(' | ')}` : a.title;
}
