import { modal, nameTable } from './dialog';

/** One press of a key turns the camera by this [rad], or moves it by this share of the view's height. */
const kTurn = Math.PI / 18;
const kMove = 0.05;

/** Descriptions of the keys for the user. */
const kKeys: [string, string][] = [
  ['space', 'play, pause'],
  ['← →', 'one stored frame (with shift ten)'],
  ['home, end', 'begin, end'],
  ['↑ ↓', 'another mode, in pages with modes'],
  ['+ −', 'nearer, further'],
  ['1 2 3 · 0', 'seen along x, y, z · from the corner'],
  ['q w · page up, page down', 'turn · tilt; with shift: move'],
  ['f · o', 'fit: the whole run in view · parallel or perspective'],
  ['[ ]', 'less, more deformation'],
  ['v, shift v', 'next, previous field'],
  ['j a r b l u s', 'joints, loads, joint forces, frames, names, undeformed shape, colours'],
  ['e · x', 'edges of elements · section'],
  ['t', 'light, dark, as the system has it'],
  ['p · m', 'save the picture · record a video, or end it'],
  ['click on a body', 'follow the nearest node, or no longer'],
  ['drag', 'turn; right button or ctrl: move; wheel: zoom'],
  ['click or drag in a curve', 'go to that time; wheel with shift or ctrl: zoom, double click: all'],
  ['?', 'this list'],
];

export interface KeyActions {
  toggle(): void;
  stepFrames(frames: number): void;
  toStart(): void;
  toEnd(): void;
  fit(): void;
  zoom(factor: number): void;
  turn(aside: number, up: number): void;
  /** In fractions of the view's height. */
  move(aside: number, up: number): void;
  /** Along axis 0, 1, 2; −1: from the corner. */
  lookAlong(axis: number): void;
  deform(factor: number): void;
  nextField(steps: number): void;
  project(): void;
  /** Any other key; false if it has no function. */
  other(key: string): boolean;
}

/** Keys of the whole page; keys that the focused control handles itself are left to it. */
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
    if (this.act(event.key, event.shiftKey)) event.preventDefault();
  }

  private act(key: string, shift: boolean): boolean {
    const { actions } = this;
    const frames = shift ? 10 : 1;
    const tilt = (up: number) => (shift ? actions.move(0, up * kMove) : actions.turn(0, up * kTurn));
    const known: Record<string, () => void> = {
      ' ': () => actions.toggle(),
      ArrowLeft: () => actions.stepFrames(-frames),
      ArrowRight: () => actions.stepFrames(frames),
      Home: () => actions.toStart(),
      End: () => actions.toEnd(),
      f: () => actions.fit(),
      '+': () => actions.zoom(1.25),
      '=': () => actions.zoom(1.25),
      '-': () => actions.zoom(0.8),
      q: () => actions.turn(-kTurn, 0),
      w: () => actions.turn(kTurn, 0),
      Q: () => actions.move(-kMove, 0),
      W: () => actions.move(kMove, 0),
      PageUp: () => tilt(1),
      PageDown: () => tilt(-1),
      '1': () => actions.lookAlong(0),
      '2': () => actions.lookAlong(1),
      '3': () => actions.lookAlong(2),
      '0': () => actions.lookAlong(-1),
      '[': () => actions.deform(1 / 1.5),
      ']': () => actions.deform(1.5),
      v: () => actions.nextField(1),
      V: () => actions.nextField(-1),
      o: () => actions.project(),
      '?': () => this.help.showModal(),
    };
    const action = known[key];
    if (!action) return actions.other(key);
    action();
    return true;
  }
}
