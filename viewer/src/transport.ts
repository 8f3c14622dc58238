import { el } from './dom';
import { figure, TimeFormat } from './quantity';
import type { Playback } from './playback';
import type { ViewOptions } from './view_options';

/** Ratio between the default speed and the ends of the speed slider. */
const kSpeedSpan = 32;
const kMostScale = 1e5;

const kPlay = '<svg viewBox="0 0 16 16"><path d="M4 2.5v11l9-5.5z"/></svg>';
const kPause = '<svg viewBox="0 0 16 16"><path d="M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z"/></svg>';

/** The bar under the view: play, time, speed, magnification of the deformation. */
export class Transport {
  readonly root: HTMLElement;
  private readonly play = el('button', { class: 'play', type: 'button' });
  private readonly scrub = el('input', {
    type: 'range',
    class: 'scrub',
    min: 0,
    max: 1,
    step: 'any',
    'aria-label': 'Time',
  });
  private readonly present = el('output', { class: 'clock' });
  private readonly speed = el('input', {
    type: 'range',
    min: -1,
    max: 1,
    step: 0.01,
    value: 0,
    'aria-label': 'Speed',
  });
  private readonly speedText = el('output', {});
  private readonly scale = el('input', {
    type: 'range',
    min: 0,
    max: 1,
    step: 0.005,
    'aria-label': 'Deformation scale',
  });
  private readonly scaleNumber = el('input', {
    type: 'number',
    min: 1,
    max: kMostScale,
    step: 'any',
    'aria-label': 'Deformation scale, number',
  });
  private format: TimeFormat;
  private usualSpeed: number;

  /** @param clock unit of the time shown */
  constructor(
    private readonly playback: Playback,
    private readonly clock: 's' | 'steps',
    private readonly options: ViewOptions,
    deformable: boolean,
    private readonly changed: () => void,
    private readonly visibleScale: () => number,
  ) {
    this.format = new TimeFormat(playback.duration, clock);
    this.usualSpeed = playback.speed;
    this.play.addEventListener('click', () => this.toggle());
    this.scrub.addEventListener('input', () => {
      playback.playing = false;
      playback.setFraction(Number(this.scrub.value));
      changed();
    });
    this.speed.addEventListener('input', () => {
      playback.speed = this.usualSpeed * kSpeedSpan ** Number(this.speed.value);
      changed();
    });
    this.speed.addEventListener('dblclick', () => {
      this.speed.value = '0';
      playback.speed = this.usualSpeed;
      changed();
    });
    this.scale.addEventListener('input', () =>
      this.setScale(kMostScale ** Number(this.scale.value)),
    );
    this.scaleNumber.addEventListener('change', () =>
      this.setScale(Number(this.scaleNumber.value)),
    );

    const speedField = el(
      'label',
      { class: 'field', title: 'Simulated time, or steps, per second of watching; double click resets' },
      'Speed',
      this.speed,
      this.speedText,
    );
    const scaleField = el(
      'div',
      {
        class: 'field',
        title:
          'Magnifies nodal displacements and rotations in the body frame; above 1 joints no longer meet',
      },
      'Deformation',
      this.scale,
      this.scaleNumber,
      '×',
      el(
        'button',
        {
          type: 'button',
          class: 'small',
          'data-auto-scale': '',
          title: 'Magnify the largest displacement to a twentieth of the size, or show it as it is',
          click: () => this.setScale(options.scale === 1 ? this.visibleScale() : 1),
        },
        'auto',
      ),
    );
    this.root = el(
      'footer',
      { class: 'transport' },
      el('div', { class: 'line' }, this.play, this.scrub, this.present),
      el('div', { class: 'line fields' }, speedField, ...(deformable ? [scaleField] : [])),
    );
    if (!playback.canPlay) {
      for (const control of [this.play, this.scrub, this.speed]) control.disabled = true;
    }
    this.update();
  }

  /** The run has another duration: it takes `seconds` at the default speed. */
  restart(seconds: number): void {
    const { playback } = this;
    const factor = playback.speed / this.usualSpeed;
    this.format = new TimeFormat(playback.duration, this.clock);
    this.usualSpeed = Number((playback.duration / seconds).toPrecision(2));
    playback.speed = factor * this.usualSpeed;
    playback.setTime(playback.time);
  }

  toggle(): void {
    if (!this.playback.canPlay) return;
    this.playback.playing = !this.playback.playing;
    this.changed();
  }

  setScale(scale: number): void {
    this.options.scale = Number.isFinite(scale) ? Math.min(kMostScale, Math.max(1, scale)) : 1;
    this.changed();
  }

  /** Shows the current state of playback and options. */
  update(): void {
    const { playback, options } = this;
    if (this.play.dataset.playing !== String(playback.playing)) {
      this.play.dataset.playing = String(playback.playing);
      this.play.innerHTML = playback.playing ? kPause : kPlay;
      const action = playback.playing ? 'Pause' : 'Play';
      this.play.setAttribute('aria-label', action);
      this.play.title = `${action} (space)`;
    }
    this.scrub.value = String(playback.fraction);
    this.scrub.style.setProperty('--done', `${100 * playback.fraction}%`);
    const time = this.format.number(playback.time);
    this.present.textContent = `${time} / ${this.format.number(playback.end)} ${this.format.unit}`;
    this.scrub.setAttribute('aria-valuetext', `${time} ${this.format.unit}`);
    const speed = figure(playback.speed, 2);
    const rate = this.clock === 's' ? `${speed}× real time` : `${speed} steps per second`;
    this.speedText.textContent = rate;
    this.speed.setAttribute('aria-valuetext', rate);
    this.scale.value = String(Math.log(options.scale) / Math.log(kMostScale));
    this.scale.setAttribute('aria-valuetext', `${figure(options.scale, 3)} times`);
    if (document.activeElement !== this.scaleNumber) {
      this.scaleNumber.value = String(Number(options.scale.toPrecision(3)));
    }
  }
}
