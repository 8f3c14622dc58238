import { kRunNames } from './charts';
import { el } from './dom';
import { figure, prefixFor } from './quantity';
import { isPickable, pickName, type Pick } from './picks';
import { nodeNumbered, type Run } from './run';
import { pointOf } from './field_point';
import { orZero, type ChartContent, type Curve } from './chart';
import type { FieldItem } from './fields';
import type { Triple } from './page_data';

/** More could not be told apart. */
const kMostPicks = 8;

export interface PickValues {
  /** World position at the current time [m]. */
  position(pick: Pick): Triple;
  /** Positions are those of the undeformed body. */
  atRest: boolean;
  /** Value of the field in every frame. */
  history(pick: Pick): Float32Array;
  item(): FieldItem | undefined;
  /** Threshold below which values of a unit are shown as zero. */
  least(unit: string): number;
}

/** The nodes that the user follows: names, positions and values. */
export class PickPanel {
  readonly root: HTMLElement;
  readonly picks: Pick[] = [];
  private readonly list = el('ul', { class: 'picks' });
  private readonly body: HTMLSelectElement;
  private readonly number: HTMLInputElement;
  private readonly message = el('span', { class: 'pick-message', role: 'status' });
  private curves: Curve[] = [];
  private outputs: { position: HTMLElement; value: HTMLElement }[] = [];

  /** `changed` gets the curves of the nodes, null without any. */
  constructor(
    private readonly runs: Run[],
    private readonly values: PickValues,
    private readonly changed: (content: ChartContent | null) => void,
  ) {
    this.body = el('select', { 'aria-label': 'Body of the node' });
    runs.forEach((run, pane) => {
      run.bodies.forEach((body, i) => {
        if (!isPickable(body)) return;
        const name = runs.length > 1 ? `${body.name} ${kRunNames[pane]!}` : body.name;
        this.body.append(el('option', { value: `${pane}/${i}` }, name));
      });
    });
    this.number = el('input', { type: 'number', min: 0, step: 1, 'aria-label': 'Number of the node' });
    const form = el(
      'form',
      { class: 'pick-form' },
      this.body,
      this.number,
      el('button', { type: 'submit', class: 'small' }, 'Follow'),
    );
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.addByNumber();
    });
    const hint = el('span', { class: 'unit' }, 'click on a body, or by number');
    this.root = el(
      'section',
      { class: 'pick-panel', 'aria-label': 'Followed nodes' },
      el('div', { class: 'pick-head' }, el('h2', {}, 'Nodes'), hint),
      form,
      this.message,
      this.list,
    );
    this.root.hidden = this.body.options.length === 0;
  }

  private addByNumber(): void {
    const [pane, body] = this.body.value.split('/').map(Number) as [number, number];
    const shape = this.runs[pane]!.bodies[body]!;
    const node = this.number.value === '' ? -1 : nodeNumbered(shape, Number(this.number.value));
    if (node < 0) {
      const why = shape.nodeNumbers ? ' on its surface' : '';
      this.message.textContent = `${shape.name} has no node ${this.number.value || '…'}${why}.`;
      return;
    }
    this.flip({ ...pointOf(shape, node), pane, body });
    this.number.value = '';
  }

  /** Follows a node, or stops if it is followed already. */
  flip(pick: Pick): void {
    const same = (other: Pick) =>
      other.pane === pick.pane && other.body === pick.body && other.node === pick.node;
    const at = this.picks.findIndex(same);
    this.message.textContent = '';
    if (at >= 0) this.picks.splice(at, 1);
    else if (this.picks.length < kMostPicks) this.picks.push(pick);
    else this.message.textContent = `${kMostPicks} nodes at most.`;
    this.refresh();
  }

  private name({ pane, body, ...rest }: Pick): string {
    const name = pickName(this.runs[pane]!.bodies[body]!, { pane, body, ...rest });
    return this.runs.length > 1 ? `${name} ${kRunNames[pane]!}` : name;
  }

  /** Rebuilds list and curves after nodes or the field have changed. */
  refresh(): void {
    const item = this.values.item();
    this.curves = this.picks.map((pick, color) => ({
      label: this.name(pick),
      times: this.runs[pick.pane]!.times,
      values: this.values.history(pick),
      stride: 1,
      offset: 0,
      color,
      dashed: false,
    }));
    this.outputs = [];
    const lines = this.picks.map((pick, i) => {
      const name = this.name(pick);
      const [position, value] = [el('span', { class: 'position' }), el('b')];
      this.outputs.push({ position, value });
      const swatch = el('i', { class: 'swatch', 'data-pick': i });
      const remove = el(
        'button',
        { type: 'button', class: 'icon', 'aria-label': `Do not follow node ${name}`, click: () => this.flip(pick) },
        '✕',
      );
      return el('li', {}, swatch, el('span', { class: 'name' }, `node ${name}`), value, remove, position);
    });
    this.list.replaceChildren(...lines);
    const shown = item && this.curves.length > 0;
    this.changed(shown ? { name: item.label, unit: item.unit === '1' ? '' : item.unit, curves: this.curves } : null);
  }

  /** Position and value now; `value` reads a curve at the current time. */
  update(value: (curve: Curve) => number, colors: string[], length: number): void {
    const item = this.values.item();
    const { factor, unit } = prefixFor(length, 'm');
    this.picks.forEach((pick, i) => {
      const { position, value: out } = this.outputs[i]!;
      // Lengths negligible beside the model are shown as zero.
      const near = (x: number) => (Math.abs(x) < 1e-6 * length ? 0 : x);
      const p = this.values.position(pick).map((x) => figure(near(x) / factor, 4));
      position.textContent = `${this.values.atRest ? 'at rest at' : 'at'} ${p.join(', ')} ${unit}`;
      const plain = item?.unit === '1' ? '' : (item?.unit ?? '');
      const now = orZero(value(this.curves[i]!), this.values.least(plain));
      const prefix = prefixFor(Math.abs(now), plain);
      out.textContent = Number.isFinite(now)
        ? `${figure(now / prefix.factor)} ${prefix.unit}`
        : 'not recorded';
      const swatch = this.list.children[i]!.querySelector<HTMLElement>('.swatch')!;
      swatch.style.setProperty('--curve', colors[i % colors.length]!);
    });
  }
}
