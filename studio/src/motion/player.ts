/** Where the animation of a planned path is. */
import type { PlannedPath } from './messages';
import type { Positions } from './robot';

/** RViz's `State Display Time`. */
export const DISPLAY_TIMES = ['3x', 'REALTIME', '0.05 s', '0.1 s', '0.5 s'] as const;

/** Plays a path; time is in seconds of the animation at single speed. */
export class Player {
  path: PlannedPath | null = null;
  playing = false;
  loop = false;
  /** Whether all of the path's states are drawn. */
  trail = false;
  private place_s = 0;
  private mode = '3x';
  private last = 0;

  /** Begin with a path. */
  load(path: PlannedPath | null): void {
    this.path = path?.points.length ? path : null;
    this.place_s = 0;
    this.last = 0;
    this.playing = this.path !== null;
  }

  get displayTime(): string {
    return this.mode;
  }

  /** `REALTIME`, `3x` or seconds for each state: `0.05 s`. What is not understood is refused. */
  setDisplayTime(text: string): boolean {
    const word = text.trim();
    const [, number] = /^(\d*\.?\d+)\s*[xs]?$/i.exec(word) ?? [];
    if (!/^REALTIME$/i.test(word) && !(Number(number) > 0)) return false;
    const part = this.place_s / (this.duration_s || 1);
    this.mode = word;
    this.place_s = part * this.duration_s;
    return true;
  }

  /** How long the path takes on the screen. */
  get duration_s(): number {
    if (!this.path) return 0;
    return this.times[this.times.length - 1] ?? 0;
  }

  get time_s(): number {
    return this.place_s;
  }

  /** Go to a time and stay there. */
  seek(time_s: number): void {
    this.playing = false;
    this.place_s = Math.max(0, Math.min(time_s, this.duration_s));
  }

  /** Go on, from the beginning when it was at the end. */
  play(): void {
    if (!this.path) return;
    if (this.place_s >= this.duration_s) this.place_s = 0;
    this.last = 0;
    this.playing = true;
  }

  /** Move on to a time of the screen, ms. True while it plays. */
  tick(now: number): boolean {
    if (!this.playing || !this.path) return false;
    if (this.last) this.place_s += ((now - this.last) / 1000) * this.speed;
    this.last = now;
    if (this.place_s >= this.duration_s) {
      if (this.loop && this.duration_s > 0) this.place_s %= this.duration_s;
      else {
        this.place_s = this.duration_s;
        this.playing = false;
      }
    }
    return this.playing;
  }

  /** Where the robot is now, between two points of the path. */
  positions(): Positions | null {
    if (!this.path) return null;
    const { points } = this.path;
    const { times } = this;
    const after = times.findIndex((time) => time >= this.place_s);
    if (after <= 0) return points[after === 0 ? 0 : points.length - 1];
    const share = (this.place_s - times[after - 1]) / (times[after] - times[after - 1] || 1);
    const [a, b] = [points[after - 1], points[after]];
    return Object.fromEntries(
      Object.keys(b).map((name) => [name, a[name] + (b[name] - a[name]) * share]),
    );
  }

  private get speed(): number {
    const factor = /^([\d.]+)\s*x$/i.exec(this.mode);
    return factor ? Number(factor[1]) : 1;
  }

  private get times(): number[] {
    const state = /^([\d.]+)\s*s?$/i.exec(this.mode);
    const { points, times_s } = this.path as PlannedPath;
    return state ? points.map((_, at) => at * Number(state[1])) : times_s;
  }
}
