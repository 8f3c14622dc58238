import type { Views } from './views';

/** Pictures per second of a video. */
const kRate = 30;
const kBitsPerSecond = 8e6;
/** Wall time for which the last picture of a video stays [ms]. */
const kLinger = 300;
const kMargin = 10;

export interface CaptureSource {
  title: string;
  /** What the clock shows; empty: nothing. */
  time(): string;
  background(): string;
  ink(): string;
  /** Draws the present state, so that the pictures can be copied. */
  redraw(): void;
}

/** Whether the browser can make videos. */
export function canRecord(): boolean {
  const can = typeof MediaRecorder !== 'undefined' && 'captureStream' in HTMLCanvasElement.prototype;
  return can && MediaRecorder.isTypeSupported('video/webm');
}

/** A name for a file: letters and digits of a title. */
export function fileName(title: string, ending: string): string {
  const words = title.normalize('NFKD').replace(/[^A-Za-z0-9]+/g, '_').replace(/^_+|_+$/g, '');
  return `${words.slice(0, 60) || 'buckens'}.${ending}`;
}

function save(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60e3);
}

/** Saves what the views show, with names and time, as a picture or a video. */
export class Capture {
  private readonly canvas = document.createElement('canvas');
  private recorder: MediaRecorder | null = null;

  constructor(
    private readonly views: Views,
    private readonly source: CaptureSource,
  ) {}

  get isRecording(): boolean {
    return this.recorder !== null;
  }

  picture(): void {
    // What WebGL has drawn is gone after the task that drew it.
    this.source.redraw();
    this.compose();
    this.canvas.toBlob((blob) => blob && save(blob, fileName(this.source.title, 'png')), 'image/png');
  }

  begin(): void {
    if (this.recorder || !canRecord()) return;
    this.source.redraw();
    this.compose();
    const parts: Blob[] = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(kRate), {
      mimeType: 'video/webm',
      videoBitsPerSecond: kBitsPerSecond,
    });
    recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
    recorder.addEventListener('stop', () => {
      const blob = new Blob(parts, { type: 'video/webm' });
      if (blob.size > 0) save(blob, fileName(this.source.title, 'webm'));
    });
    recorder.start();
    this.recorder = recorder;
  }

  /** Adds the picture just drawn to a video; to be called in the task that drew it. */
  take(): void {
    if (this.recorder) this.compose(true);
  }

  end(): void {
    this.recorder?.stop();
    this.recorder = null;
  }

  /** Ends after the last picture has been seen for a moment. */
  endSoon(): void {
    const { recorder } = this;
    setTimeout(() => {
      if (this.recorder === recorder) this.end();
      this.source.redraw();
    }, kLinger);
  }

  /** Puts the panes side by side. @param keep the size of the pictures before */
  private compose(keep = false): void {
    const { canvas, source } = this;
    const panes = this.views.panes.filter((pane) => pane.stage);
    if (panes.length === 0) return;
    const boxes = panes.map((pane) => pane.root.getBoundingClientRect());
    const [left, top] = [Math.min(...boxes.map((b) => b.left)), Math.min(...boxes.map((b) => b.top))];
    const right = Math.max(...boxes.map((b) => b.right));
    const bottom = Math.max(...boxes.map((b) => b.bottom));
    const ratio = panes[0]!.stage!.canvas.width / Math.max(1, boxes[0]!.width);
    if (!keep) {
      // Videos need even numbers.
      canvas.width = 2 * Math.round((ratio * (right - left)) / 2);
      canvas.height = 2 * Math.round((ratio * (bottom - top)) / 2);
    }
    const pen = canvas.getContext('2d')!;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = source.background();
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.scale(canvas.width / (right - left), canvas.height / (bottom - top));
    panes.forEach((pane, i) => {
      const box = boxes[i]!;
      pen.drawImage(pane.stage!.canvas, box.left - left, box.top - top, box.width, box.height);
      this.write(pen, pane.stage!.labels.root, left, top);
    });
    pen.fillStyle = source.ink();
    pen.font = '14px system-ui, sans-serif';
    pen.textBaseline = 'top';
    const time = source.time();
    pen.fillText(time ? `${source.title}, ${time}` : source.title, kMargin, kMargin);
  }

  /** The names over a pane. */
  private write(pen: CanvasRenderingContext2D, labels: HTMLElement, left: number, top: number): void {
    pen.textBaseline = 'middle';
    for (const span of labels.querySelectorAll('span')) {
      if (span.hidden) continue;
      const box = span.getBoundingClientRect();
      const style = getComputedStyle(span);
      pen.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      pen.fillStyle = style.color;
      const inside = parseFloat(style.paddingLeft) || 0;
      pen.fillText(span.textContent ?? '', box.left - left + inside, (box.top + box.bottom) / 2 - top);
    }
  }
}
