/** Where coordinate frames are in the fixed frame: the `tf` stream, once for a view. */
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import { floats, type Frame } from '../binary_frame';
import type { FrameNames, TfFrame } from '../generated/messages';
import { isObject, type Json } from '../json';

const POSE_LENGTH = 7;
const IDENTITY = [0, 0, 0, 0, 0, 0, 1];
/** Broadcasters of a launch come up one after the other. */
const PATIENCE_MS = 3000;
/** When there is no tf at all, that is said after a while. */
const LONG_PATIENCE_MS = 10_000;

/** All frames, and who wants to know. */
export class Frames {
  infos: TfFrame[] = [];
  /** Of all frames, and at the end that of the fixed frame in itself, which needs no tf. */
  poses: Float32Array = new Float32Array(IDENTITY);
  fixed = '';
  /** The link that a robot on view stands on, of interest while tf tells of no frame. */
  robotRoot = '';
  /** Whether tf has had time to come up: what is missing now is missing. */
  settled = false;
  private patience: ReturnType<typeof setTimeout> | undefined;
  private index = new Map<string, number>();
  private channel: Channel | null = null;
  private readonly moved = new Set<() => void>();
  private readonly renamed = new Set<() => void>();

  constructor(private readonly connection: Connection) {
    this.waitFor(LONG_PATIENCE_MS);
  }

  /** Choose the fixed frame; opens the stream at first. */
  setFixed(name: string): void {
    if (name === this.fixed && this.channel) return;
    this.fixed = name;
    const params = { fixed_frame: name };
    if (this.channel) this.channel.change(params);
    else {
      this.channel = this.connection.open('tf', params, {
        onData: (value) => this.takeNames(value),
        onFrame: (frame) => this.takePoses(frame),
      });
    }
  }

  /** Where the pose of a frame begins in `poses`; -1 when there is no way to it. */
  at(name: string): number {
    const clean = name.replace(/^\//, '');
    const index = this.index.get(clean) ?? this.index.get(name);
    const own = this.poses.length - POSE_LENGTH;
    if (index === undefined) return clean === this.fixed.replace(/^\//, '') ? own : -1;
    const at = index * POSE_LENGTH;
    return at < own && !Number.isNaN(this.poses[at]) ? at : -1;
  }

  /** Tell on which link a robot stands. */
  setRobotRoot(name: string): void {
    if (name === this.robotRoot) return;
    this.robotRoot = name;
    this.renamed.forEach((listener) => listener());
  }

  /** Be called after every new set of poses. Returns what ends it. */
  onMoved(listener: () => void): () => void {
    this.moved.add(listener);
    return () => this.moved.delete(listener);
  }

  /** Be called when frames come, go or change parents. Returns what ends it. */
  onRenamed(listener: () => void): () => void {
    this.renamed.add(listener);
    return () => this.renamed.delete(listener);
  }

  /** Hidden views need no poses. */
  hold(held: boolean): void {
    this.channel?.hold(held);
  }

  dispose(): void {
    clearTimeout(this.patience);
    this.channel?.close();
    this.channel = null;
  }

  private takeNames(value: Json): void {
    if (!isObject(value) || !Array.isArray(value.frames)) return;
    const [had, has] = [this.infos.length > 0, value.frames.length > 0];
    if (had !== has) this.waitFor(has ? PATIENCE_MS : LONG_PATIENCE_MS);
    this.infos = (value as unknown as FrameNames).frames;
    this.index = new Map(this.infos.map((info, index) => [info.name, index]));
    this.renamed.forEach((listener) => listener());
  }

  private waitFor(patience_ms: number): void {
    clearTimeout(this.patience);
    this.settled = false;
    this.patience = setTimeout(() => {
      this.settled = true;
      this.renamed.forEach((listener) => listener());
    }, patience_ms);
  }

  private takePoses(frame: Frame): void {
    const length = frame.count * POSE_LENGTH;
    this.poses = new Float32Array(length + POSE_LENGTH);
    this.poses.set(floats(frame, length));
    this.poses.set(IDENTITY, length);
    this.moved.forEach((listener) => listener());
  }
}
