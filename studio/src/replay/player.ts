/** The time of a replay: it plays, stands still, or is set by hand. */

/** Hears of every new time, and of playing and pausing. */
export type Listener = (time_s: number) => void;

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];

/** Seconds since the recording's start. */
export class Player {
  time_s = 0;
  playing = false;
  speed = 1;
  readonly speeds = SPEEDS;
  private readonly listeners: Listener[] = [];
  private last = 0;

  constructor(readonly duration_s: number) {}

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** Play on, from the start where the end is reached. */
  play(): void {
    if (this.playing || this.duration_s <= 0) return;
    if (this.time_s >= this.duration_s) this.time_s = 0;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame((now) => this.turn(now));
    this.tell();
  }

  pause(): void {
    this.playing = false;
    this.tell();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Go to a time within the recording. */
  seek(time_s: number): void {
    this.time_s = Math.max(0, Math.min(this.duration_s, time_s));
    this.tell();
  }

  private turn(now: number): void {
    if (!this.playing) return;
    // A page that was hidden has not missed anything.
    const passed_s = Math.min(0.25, Math.max(0, (now - this.last) / 1000));
    this.last = now;
    this.time_s += passed_s * this.speed;
    if (this.time_s >= this.duration_s) {
      this.time_s = this.duration_s;
      this.playing = false;
    } else requestAnimationFrame((next) => this.turn(next));
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener(this.time_s);
  }
}
