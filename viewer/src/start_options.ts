import type { FieldItem } from './fields';
import type { ViewOptions } from './view_options';

/**
 * Initial view of the page: stresses in colour if there are any; for vibrations their shape. A single
 * instant, such as that of `buckens check --view`, has names, markers and axes.
 */
export function startOptions(items: FieldItem[], isStill = false): ViewOptions {
  const stress =
    items.find(({ id }) => id === 'von_mises') ??
    items.find(({ unit }) => unit === 'Pa') ??
    items.find(({ id }) => id === 'relative_displacement/magnitude');
  return {
    frames: isStill,
    joints: true,
    loads: true,
    reactions: false,
    labels: isStill,
    undeformed: false,
    colors: stress !== undefined,
    field: {
      item: (stress ?? items[0])?.id ?? '',
      range: 'run',
      low: 0,
      high: 0,
      perElement: false,
      map: 'spectrum',
      bands: 0,
      cut: 'none',
      cutLow: null,
      cutHigh: null,
    },
    edges: 'auto',
    section: { axis: 'off', body: '', fraction: 0.5, flip: false },
    scale: 1,
    trace: null,
  };
}
