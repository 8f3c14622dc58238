import { el } from './dom';
import type { Run } from './run';
import type { ViewOptions } from './view_options';

export type Toggle = 'joints' | 'frames' | 'labels' | 'undeformed' | 'stress';

interface ToggleEntry {
  name: Toggle;
  text: string;
  key: string;
  title: string;
}

const kToggles: ToggleEntry[] = [
  { name: 'joints', text: 'Joints', key: 'j', title: 'Joints, supports and springs' },
  { name: 'frames', text: 'Frames', key: 'b', title: 'Buckens frames of the bodies' },
  { name: 'labels', text: 'Names', key: 'l', title: 'Names; with frames shown also of markers' },
  { name: 'undeformed', text: 'Undeformed', key: 'u', title: 'Undeformed shape as a ghost' },
  { name: 'stress', text: 'Stress', key: 's', title: 'Stress of each element in colour' },
];

/** Buttons over the view that say what is drawn. */
export class Toolbar {
  readonly root: HTMLElement;
  private readonly buttons = new Map<Toggle, HTMLButtonElement>();

  constructor(
    run: Run,
    private readonly options: ViewOptions,
    private readonly changed: () => void,
  ) {
    const deformable = run.bodies.some((body) => body.displacement);
    const stressed = run.bodies.some((body) => body.stress || body.solidStress);
    const offered = kToggles.filter(
      ({ name }) => (name !== 'undeformed' || deformable) && (name !== 'stress' || stressed),
    );
    for (const { name, text, key, title } of offered) {
      const button = el(
        'button',
        {
          type: 'button',
          'data-toggle': name,
          title: `${title} (${key})`,
          click: () => this.flip(name),
        },
        text,
      );
      this.buttons.set(name, button);
    }
    this.root = el(
      'div',
      { class: 'toolbar', role: 'toolbar', 'aria-label': 'What is shown' },
      ...this.buttons.values(),
      this.traceChoice(run),
    );
    this.update();
  }

  private traceChoice(run: Run): HTMLElement {
    const select = el('select', {
      class: 'trace',
      'aria-label': 'Trace of a point',
      title: 'Path of a point',
    });
    select.append(el('option', { value: '' }, 'No trace'));
    run.bodies.forEach((body, b) => {
      const points = body.markers.map((marker, m) => ({ m, text: `${body.name}/${marker.name}` }));
      for (const { m, text } of [...points, { m: -1, text: `${body.name} (mass centre)` }]) {
        select.append(el('option', { value: `${b}/${m}` }, text));
      }
    });
    select.addEventListener('change', () => {
      const [body, marker] = select.value.split('/').map(Number);
      this.options.trace = select.value === '' ? null : { body: body!, marker: marker! };
      this.changed();
    });
    return select;
  }

  flip(name: Toggle): void {
    if (!this.buttons.has(name)) return;
    this.options[name] = !this.options[name];
    this.changed();
  }

  /** Flips what the key stands for; false if it stands for nothing here. */
  key(key: string): boolean {
    const entry = kToggles.find((toggle) => toggle.key === key);
    if (!entry || !this.buttons.has(entry.name)) return false;
    this.flip(entry.name);
    return true;
  }

  update(): void {
    for (const [name, button] of this.buttons) {
      button.setAttribute('aria-pressed', String(this.options[name]));
    }
  }
}
