/** Topics as they were at a time. */
import type { Motion } from './motion';
import { lastBefore, type ColumnHead, type Recording, type TopicHead } from './unpacking';

/** A field of a topic. */
export class Column {
  readonly name: string;
  /** Whether it can be drawn as a curve. */
  readonly isNumber: boolean;
  private values: Float64Array | null = null;

  constructor(
    private readonly recording: Recording,
    readonly topic: Topic,
    private readonly head: ColumnHead,
    label: string,
  ) {
    this.name = label ? `${head.name} (${label})` : head.name;
    this.isNumber = [head.number, head.step, head.values].some((one) => one !== undefined);
  }

  /** The title of its curve. */
  get title(): string {
    return `${this.topic.name} ${this.name}`;
  }

  /** Its values, one for each row of the topic. */
  series(): Float64Array {
    if (this.values) return this.values;
    const { number, low = 0, step = 1, at, gaps = [], values } = this.head;
    const count = this.topic.times.length;
    if (values) this.values = values;
    else if (at) this.values = this.recording.integers(at).map((value) => low + value * step);
    else this.values = new Float64Array(count).fill(number ?? Number.NaN);
    for (const row of gaps) this.values[row] = Number.NaN;
    return this.values;
  }

  /** Its value in a row, for people. */
  text(row: number): string {
    const { head } = this;
    if (row < 0) return '';
    if (head.text !== undefined) return head.text;
    if (head.words && head.at) {
      this.values ??= this.recording.integers(head.at);
      return head.words[this.values[row]] ?? '';
    }
    const value = this.series()[row];
    if (!Number.isFinite(value)) return '–';
    return Number.isInteger(value) && Math.abs(value) < 1e9 ? String(value) : short(value);
  }
}

/** A topic and its fields. */
export class Topic {
  readonly name: string;
  readonly type: string;
  readonly count: number;
  /** Seconds, rising. */
  readonly times: Float64Array;
  readonly columns: Column[];

  constructor(recording: Recording, head: TopicHead, times?: Float64Array) {
    this.name = head.name;
    this.type = head.type;
    this.count = head.count;
    this.times = times ?? recording.integers(head.times).map((value) => value * 1e-6);
    // What is in `position` is said by the same place of `name`.
    const labels = new Map(
      head.columns
        .filter((one) => one.text && /^name\.\d+$/.test(one.name))
        .map((one) => [one.name.slice(4), one.text as string]),
    );
    this.columns = head.columns.map((one) => {
      const end = /^(position|velocity|effort)(\.\d+)$/.exec(one.name)?.[2] ?? '';
      return new Column(recording, this, one, labels.get(end) ?? '');
    });
  }

  /** The row of the last message at a time; -1 before the first. */
  rowAt(time_s: number): number {
    return lastBefore(this.times, time_s + 1e-9);
  }
}

/** Where each model is, as topics that nobody published. */
export function modelTopics(recording: Recording, motion: Motion): Topic[] {
  const { scene, frames } = recording.head;
  const times = Float64Array.from({ length: frames.count }, (_, i) =>
    Math.min(i * frames.period_s, frames.duration_s),
  );
  return scene.models
    .filter((one) => !one.static && one.bodies.some((body) => motion.moves(body)))
    .map((model) => {
      const poses = [...times.keys()].map((frame) => motion.poseAt(model.bodies[0], frame));
      const column = (name: string, of: (pose: number[]) => number): ColumnHead => ({
        name,
        values: Float64Array.from(poses, of),
      });
      const columns = [
        column('x', (pose) => pose[0]),
        column('y', (pose) => pose[1]),
        column('z', (pose) => pose[2]),
        column('yaw', ([, , , x, y, z, w]) =>
          Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
        ),
      ];
      const head = { name: model.name, type: 'pose in the world, m and rad', count: frames.count };
      return new Topic(recording, { ...head, times: [0, 0, 0, 0, 0], columns }, times);
    });
}

/** A number in few digits. */
export function short(value: number): string {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return value.toExponential(3);
  return String(Number(value.toPrecision(5)));
}
