/** Screenshot and video of a view. */
import type { View } from './view';

const VIDEO_FPS = 30;

/** Take a picture of the view as PNG. */
export function screenshot(view: View): Promise<Blob> {
  return new Promise((resolve, reject) => {
    const stop = view.afterDraw(() => {
      stop();
      view.canvas.toBlob(
        (blob) => (blob ? resolve(blob) : reject(new Error('The picture could not be made.'))),
        'image/png',
      );
    });
    view.drawNow();
  });
}

/** A film of a view, from `start` to `stop`. */
export class Film {
  private recorder: MediaRecorder | null = null;
  private parts: Blob[] = [];
  private beat = 0;

  constructor(private readonly view: View) {}

  get running(): boolean {
    return this.recorder !== null;
  }

  start(): void {
    const stream = this.view.canvas.captureStream(VIDEO_FPS);
    const type = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find((each) =>
      MediaRecorder.isTypeSupported(each),
    );
    this.parts = [];
    this.recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 6_000_000 });
    this.recorder.ondataavailable = (event) => this.parts.push(event.data);
    this.recorder.start(1000);
    // A film of a still scene has frames too.
    this.beat = window.setInterval(() => this.view.invalidate(), 200);
    this.view.invalidate(true);
  }

  /** End the film; the file is WebM. */
  stop(): Promise<Blob> {
    const recorder = this.recorder;
    if (!recorder) return Promise.reject(new Error('No film is running.'));
    window.clearInterval(this.beat);
    this.recorder = null;
    return new Promise((resolve) => {
      recorder.onstop = () => {
        recorder.stream.getTracks().forEach((track) => track.stop());
        resolve(new Blob(this.parts, { type: 'video/webm' }));
      };
      recorder.stop();
    });
  }
}

/** Hand a file to the person. */
export function download(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A name with the time in it: `gazelle-2026-11-22-13-45-10.png`. */
export function fileName(ending: string): string {
  const time = new Date().toISOString().slice(0, 19).replace(/[:T]/g, '-');
  return `gazelle-${time}.${ending}`;
}
