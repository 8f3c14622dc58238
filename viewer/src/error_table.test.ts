import { expect, test } from 'vitest';
import { certainDigits, errorTable } from './error_table';

const stated = (value: number, uncertainty: number, parts: Record<string, number>) => ({
  value,
  t: 0.5,
  uncertainty,
  parts,
});

const kSummary = {
  errors: {
    complete: true,
    runs: [],
    notes: [] as string[],
    sensors: {
      'tip.x': {
        unit: 'm',
        resolved: true,
        sampling: 2e-6,
        not_assessed: [] as string[],
        peak: stated(0.0187654321, 1.2e-4, { 'time step': 2e-5, mesh: 9.8e-5 }),
        final: stated(-0.004, 0, { 'time step': 0, mesh: 0 }),
      },
    },
  },
};

test('values have the digits that their uncertainty leaves, with its split', () => {
  const table = errorTable(kSummary)!;
  expect(table.notes).toEqual([]);
  expect(table.rows).toEqual([
    {
      name: 'tip.x',
      peak: '0.01877 ± 1.2e−4 m',
      final: '−0.004000 ± 0 m',
      split: 'time step 2.0e−5, mesh 9.8e−5, records 2.0e−6',
    },
  ]);
});

test('what was not assessed makes a lower bound and is named', () => {
  const summary = structuredClone(kSummary);
  summary.errors.sensors['tip.x'].not_assessed = ['mesh of "plate"'];
  summary.errors.notes = ['mesh of "plate": it comes from a file'];
  const table = errorTable(summary)!;
  expect(table.rows[0]!.peak).toContain('± at least 1.2e−4 m');
  expect(table.notes).toEqual(['Not assessed: mesh of "plate": it comes from a file']);
});

test('runs without an error statement have no table', () => {
  expect(errorTable({ trust: 'ok' })).toBeNull();
});

test('an uncertainty as large as the value leaves two digits', () => {
  expect(certainDigits(1.234, 3)).toBe('1.2');
});
