import { modal, nameTable } from './dialog';

/** What the keys do, told to the user. */
const kKeys: [string, string][] = [
  ['space', 'play, pause'],
  ['← →', 'one stored frame (with shift ten)'],
  ['↑ ↓', 'another mode, in pages with modes'],
  ['home, end', 'begin, end'],
  ['f', 'fit: the whole run in view'],
  ['o', 'parallel or perspective projection'],
  ['j b l u s', 'joints, frames, names, undeformed shape, stress'],
  ['drag', 'turn; right button or ctrl: move; wheel: zoom'],
  ['click or drag in a curve', 'go to that time'],
  ['?', 'this list'],
];

export interface KeyActions {
  toggle(): void;
  stepFrames(frames: number): void;
  toStart(): void;
  toEnd(): void;
  fit(): void;
  project(): void;
  /** Any other key; false if it means nothing. */
  other(key: string): boolean;
}

/** Keys of the whole page; keys that the focused control understands itself are left to it. */
export class Keyboard {
  readonly help = modal('Keys and mouse', nameTable(kKeys));

  constructor(private readonly actions: KeyActions) {
    window.addEventListener('keydown', (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector('dialog[open]')) return;
    const target = event.target as HTMLElement;
    const range = target instanceof HTMLInputElement && target.type === 'range';
    const typing = target.matches('input, select, textarea') && !range;
    if (typing || (event.key === ' ' && target.matches('button, summary'))) return;
    if (range && /^(Arrow|Home|End|Page)/.test(event.key)) return;
    if (this.act(event.key, event.shiftKey ? 10 : 1)) event.preventDefault();
  }

  private act(key: string, frames: number): boolean {
    const { actions } = this;
    const known: Record<string, () => void> = {
      ' ': () => actions.toggle(),
      ArrowLeft: () => actions.stepFrames(-frames),
      ArrowRight: () => actions.stepFrames(frames),
      Home: () => actions.toStart(),
      End: () => actions.toEnd(),
      f: () => actions.fit(),
      o: () => actions.project(),
      '?': () => this.help.showModal(),
    };
    const action = known[key];
    if (!action) return actions.other(key);
    action();
    return true;
  }
}
