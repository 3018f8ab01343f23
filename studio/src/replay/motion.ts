/** Poses of all bodies at a time, between two frames in proportion. */
import type { Recording, TrackHead } from './unpacking';

const POSE = 7;

interface Track {
  head: TrackHead;
  places: Float64Array | null;
  turns: Float64Array | null;
}

/** The motion of a recording. */
export class Motion {
  /** Seven numbers for each body. */
  readonly poses: Float32Array;
  /** Whether each body is there. */
  readonly there: boolean[];
  private readonly tracks: Track[];

  constructor(private readonly recording: Recording) {
    this.tracks = recording.head.tracks.map((head) => ({
      head,
      places: head.places ? recording.integers(head.places) : null,
      turns: head.turns ? recording.integers(head.turns) : null,
    }));
    this.poses = new Float32Array(this.tracks.length * POSE);
    this.there = this.tracks.map(() => true);
    this.look(0);
  }

  /** Whether a body ever moves. */
  moves(body: number): boolean {
    return this.tracks[body].places !== null;
  }

  /** Where a body is at a frame; what is asked for often. */
  placeAt(body: number, frame: number): [number, number, number] {
    const { head, places } = this.tracks[body];
    if (!places || !head.steps)
      return [...(head.pose ?? [0, 0, 0])].slice(0, 3) as [number, number, number];
    const step = head.steps[0];
    return [places[3 * frame] * step, places[3 * frame + 1] * step, places[3 * frame + 2] * step];
  }

  /** The pose of a body at a frame. */
  poseAt(body: number, frame: number): number[] {
    const { head, turns } = this.tracks[body];
    if (!turns || !head.steps) return [...(head.pose ?? [0, 0, 0, 0, 0, 0, 1])];
    const turn = [0, 1, 2, 3].map((part) => turns[4 * frame + part] * (head.steps?.[1] ?? 0));
    return [...this.placeAt(body, frame), ...turn];
  }

  /** The frame of a time, with the part of the way to the next one behind the point. */
  frameAt(time_s: number): number {
    const { count, period_s, duration_s } = this.recording.head.frames;
    const before = Math.min(count - 1, Math.floor(time_s / period_s + 1e-9));
    if (before >= count - 1) return count - 1;
    const next_s = before + 1 === count - 1 ? duration_s : (before + 1) * period_s;
    return (
      before +
      Math.min(1, (time_s - before * period_s) / Math.max(1e-9, next_s - before * period_s))
    );
  }

  /** Work out all poses of a time. */
  look(time_s: number): void {
    const frame = this.frameAt(time_s);
    const first = Math.floor(frame);
    const second = Math.min(first + 1, this.recording.head.frames.count - 1);
    const share = frame - first;
    this.tracks.forEach((track, body) => {
      const { head } = track;
      this.there[body] =
        !head.there || head.there.some(([from, to]) => first >= from && first < to);
      this.write(track, body * POSE, first, second, share);
    });
  }

  private write(track: Track, at: number, first: number, second: number, share: number): void {
    const { poses } = this;
    const { head, places, turns } = track;
    if (!places || !turns || !head.steps) {
      poses.set(head.pose ?? [0, 0, 0, 0, 0, 0, 1], at);
      return;
    }
    const [place, turn] = head.steps;
    for (let axis = 0; axis < 3; axis++) {
      const from = places[3 * first + axis];
      poses[at + axis] = (from + (places[3 * second + axis] - from) * share) * place;
    }
    let length = 0;
    for (let part = 0; part < 4; part++) {
      const from = turns[4 * first + part];
      const value = (from + (turns[4 * second + part] - from) * share) * turn;
      poses[at + 3 + part] = value;
      length += value * value;
    }
    const scale = 1 / Math.sqrt(length || 1);
    for (let part = 0; part < 4; part++) poses[at + 3 + part] *= scale;
  }
}
