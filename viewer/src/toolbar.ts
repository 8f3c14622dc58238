import { el } from './dom';
import type { Run } from './run';
import type { ViewOptions } from './view_options';

export type Toggle = 'joints' | 'loads' | 'reactions' | 'frames' | 'labels' | 'undeformed' | 'colors';

interface ToggleEntry {
  name: Toggle;
  text: string;
  key: string;
  title: string;
}

const kToggles: ToggleEntry[] = [
  { name: 'joints', text: 'Joints', key: 'j', title: 'Joints, supports, springs, belts and shapes of contact' },
  { name: 'loads', text: 'Loads', key: 'a', title: 'Loads as arrows' },
  { name: 'reactions', text: 'Forces', key: 'r', title: 'Forces and torques of joints as arrows' },
  { name: 'frames', text: 'Frames', key: 'b', title: 'Buckens frames of the bodies' },
  { name: 'labels', text: 'Names', key: 'l', title: 'Names; with frames shown also of markers' },
  { name: 'undeformed', text: 'Undeformed', key: 'u', title: 'Undeformed shape as a ghost' },
  { name: 'colors', text: 'Colours', key: 's', title: 'Stress or another field in colour' },
];

/** Buttons over the view that select what is drawn. */
export class Toolbar {
  readonly root: HTMLElement;
  private readonly buttons = new Map<Toggle, HTMLButtonElement>();

  constructor(
    runs: Run[],
    private readonly options: ViewOptions,
    more: HTMLElement,
    private readonly changed: () => void,
  ) {
    const bodies = runs.flatMap((run) => run.bodies);
    const useful: Partial<Record<Toggle, boolean>> = {
      undeformed: bodies.some((body) => body.displacement),
      colors: bodies.some((body) => body.shape || body.displacement || body.fields.length > 0),
      // Loads on all bodies have no point at which to draw arrows.
      loads: runs.some((run) => run.loads.some(({ positions }) => positions.length > 0)),
      reactions: runs.some((run) => run.joints.some(({ force, torque }) => force || torque)),
    };
    const offered = kToggles.filter(({ name }) => useful[name] ?? true);
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
      more,
    );
    this.update();
  }

  flip(name: Toggle): void {
    if (!this.buttons.has(name)) return;
    this.options[name] = !this.options[name];
    this.changed();
  }

  /** Toggles the option of the key; false if the key has none here. */
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
