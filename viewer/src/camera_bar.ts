import { canRecord } from './capture';
import { el } from './dom';

export interface CameraActions {
  /** Along axis 0, 1, 2; −1: from the corner. */
  lookAlong(axis: number): void;
  fit(): void;
  project(): void;
  /** Saves what is seen as a picture. */
  picture(): void;
  /** Begins or ends the recording of a video. */
  video(): void;
  theme(): void;
  help(): void;
}

/** Buttons for the camera, the colours of the page and the list of keys. */
export class CameraBar {
  readonly root: HTMLElement;
  private readonly projection: HTMLButtonElement;
  private readonly video: HTMLButtonElement;
  private readonly theme: HTMLButtonElement;

  constructor(actions: CameraActions) {
    const button = (text: string, title: string, click: () => void, extra = {}) =>
      el('button', { type: 'button', title, click, ...extra }, text);
    this.projection = button('', 'Change the projection (o)', () => actions.project());
    const video = { 'data-video': '', 'aria-pressed': 'false' };
    this.video = button('WebM', '', () => actions.video(), video);
    this.video.hidden = !canRecord();
    this.theme = button('', '', () => actions.theme(), { 'data-theme-choice': '' });
    this.root = el(
      'div',
      { class: 'toolbar right', role: 'toolbar', 'aria-label': 'Camera' },
      button('X', 'Seen from +X (1)', () => actions.lookAlong(0)),
      button('Y', 'Seen from +Y (2)', () => actions.lookAlong(1)),
      button('Z', 'Seen from +Z (3)', () => actions.lookAlong(2)),
      button('3D', 'Seen from the corner (0)', () => actions.lookAlong(-1)),
      button('Fit', 'The whole run in view (f)', () => actions.fit(), { 'data-fit': '' }),
      this.projection,
      button('PNG', 'Save the picture (p)', () => actions.picture(), { 'data-picture': '' }),
      this.video,
      this.theme,
      button('?', 'Keys and mouse (?)', () => actions.help(), {
        'aria-label': 'Keys and mouse',
        'data-help': '',
      }),
    );
  }

  update(orthographic: boolean, theme: string, recording: boolean): void {
    this.video.setAttribute('aria-pressed', String(recording));
    this.video.title = recording
      ? 'End the video and save it (m)'
      : 'Record the run once as a video, at the speed set (m)';
    this.projection.textContent = orthographic ? 'Parallel' : 'Perspective';
    this.theme.textContent = { auto: '◐', light: '☀', dark: '☾' }[theme] ?? '';
    const text = { auto: 'as the system', light: 'light', dark: 'dark' }[theme] ?? '';
    this.theme.title = `Colours of the page: ${text} (t)`;
    this.theme.setAttribute('aria-label', this.theme.title);
  }
}
