/** Texts over the canvas that follow points of the scene and avoid each other. */

export interface Label {
  text: string;
  kind: 'body' | 'joint' | 'marker' | 'axis';
  color?: string;
  /** CSS pixels from the upper left corner of the canvas. */
  x: number;
  y: number;
}

interface Rectangle {
  left: number;
  top: number;
  width: number;
  height: number;
}

function overlaps(a: Rectangle, b: Rectangle): boolean {
  return (
    a.left < b.left + b.width &&
    b.left < a.left + a.width &&
    a.top < b.top + b.height &&
    b.top < a.top + a.height
  );
}

export class Labels {
  readonly root = document.createElement('div');
  private readonly pool: HTMLSpanElement[] = [];
  private readonly sizes = new Map<string, [number, number]>();

  constructor() {
    this.root.className = 'labels';
    this.root.setAttribute('aria-hidden', 'true');
  }

  show(labels: Label[], width: number, height: number): void {
    while (this.pool.length < labels.length) {
      const span = document.createElement('span');
      this.pool.push(span);
      this.root.append(span);
    }
    const placed: Rectangle[] = [];
    this.pool.forEach((span, i) => {
      const label = labels[i];
      const outside = !label || label.x < 0 || label.y < 0 || label.x > width || label.y > height;
      span.hidden = outside;
      if (outside) return;
      const kind = `label ${label.kind}`;
      if (span.className !== kind) span.className = kind;
      if (span.textContent !== label.text) span.textContent = label.text;
      span.style.color = label.color ?? '';
      const spot = this.spot(label, this.measure(span, label), placed);
      placed.push(spot);
      span.style.transform = `translate(${spot.left.toFixed(1)}px, ${spot.top.toFixed(1)}px)`;
    });
  }

  private measure(span: HTMLSpanElement, label: Label): [number, number] {
    // Values change from picture to picture; all digits are equally wide.
    const key = `${label.kind} ${label.text.replace(/\d/g, '0')}`;
    let size = this.sizes.get(key);
    if (!size) {
      size = [span.offsetWidth, span.offsetHeight];
      this.sizes.set(key, size);
    }
    return size;
  }

  /** First free place near the point: right above or below, left above or below, further away. */
  private spot(label: Label, [w, h]: [number, number], placed: Rectangle[]): Rectangle {
    if (label.kind === 'axis') {
      return { left: label.x - w / 2, top: label.y - h / 2, width: w, height: h };
    }
    let first: Rectangle | null = null;
    for (const away of [0, 1, 2]) {
      const gap = 9 + away * (h + 1);
      for (const [right, below] of [
        [1, 0],
        [1, 1],
        [0, 0],
        [0, 1],
      ]) {
        const left = right ? label.x + 9 : label.x - 9 - w;
        const top = below ? label.y + gap : label.y - gap - h;
        const spot = { left, top, width: w, height: h };
        first ??= spot;
        if (!placed.some((other) => overlaps(other, spot))) return spot;
      }
    }
    return first!;
  }
}
