/** The world as the page knows it, once for all panels: scene value, poses, selection. */
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import { floats } from '../binary_frame';
import type { Json, JsonObject } from '../json';
import type { Entity } from '../model/body';
import type { PageScene } from '../generated/messages';

/** What is selected: a model, or a link of one, or a light. */
export interface Selection {
  model: string;
  link?: string;
  light?: string;
}

type Listener = () => void;
const POSE_LENGTH = 7;
const stores = new WeakMap<Connection, WorldStore>();

/** The store of a connection. */
export function worldStore(connection: Connection): WorldStore {
  let found = stores.get(connection);
  if (!found) {
    found = new WorldStore(connection);
    stores.set(connection, found);
  }
  return found;
}

/** Streams `world.scene` and `world.poses`, open while somebody looks. */
export class WorldStore {
  scene: PageScene | null = null;
  poses: Float32Array = new Float32Array(0);
  selection: Selection | null = null;
  private readonly sceneListeners = new Set<Listener>();
  private readonly poseListeners = new Set<Listener>();
  private readonly selectionListeners = new Set<Listener>();
  private channels: Channel[] = [];
  private posesHeld = true;

  constructor(readonly connection: Connection) {}

  /** Be called at every change of the scene, and now. Returns what ends it. */
  onScene(listener: Listener): () => void {
    this.sceneListeners.add(listener);
    this.begin();
    listener();
    return () => this.sceneListeners.delete(listener);
  }

  /** Be called with every new set of poses. Returns what ends it. */
  onPoses(listener: Listener): () => void {
    this.poseListeners.add(listener);
    this.begin();
    this.holdPoses();
    return () => {
      this.poseListeners.delete(listener);
      this.holdPoses();
    };
  }

  /** Be called when something else is selected, and now. Returns what ends it. */
  onSelection(listener: Listener): () => void {
    this.selectionListeners.add(listener);
    listener();
    return () => this.selectionListeners.delete(listener);
  }

  select(selection: Selection | null): void {
    if (JSON.stringify(selection) === JSON.stringify(this.selection)) return;
    this.selection = selection;
    this.selectionListeners.forEach((listener) => listener());
  }

  /** Select what was clicked. */
  selectEntity(entity: Entity | null, link = false): void {
    this.select(entity ? { model: entity.model, ...(link ? { link: entity.link } : {}) } : null);
  }

  /** The newest pose of a body of the scene value, seven numbers. */
  pose(body: number): number[] {
    const at = body * POSE_LENGTH;
    if (at + POSE_LENGTH <= this.poses.length)
      return [...this.poses.subarray(at, at + POSE_LENGTH)];
    return this.scene?.bodies[body]?.pose ?? [0, 0, 0, 0, 0, 0, 1];
  }

  /** Ask the simulator for something. */
  call(method: string, params: JsonObject = {}): Promise<Json> {
    return this.connection.call(method, params);
  }

  private begin(): void {
    if (this.channels.length) return;
    const scene = this.connection.open('world.scene', {}, { onData: (value) => this.take(value) });
    const poses = this.connection.open(
      'world.poses',
      {},
      {
        onFrame: (frame) => {
          this.poses = floats(frame, frame.count * POSE_LENGTH);
          this.poseListeners.forEach((listener) => listener());
        },
      },
    );
    poses.hold(true);
    this.channels = [scene, poses];
  }

  private holdPoses(): void {
    const held = this.poseListeners.size === 0;
    if (held === this.posesHeld || this.channels.length < 2) return;
    this.posesHeld = held;
    this.channels[1].hold(held);
  }

  private take(value: Json): void {
    // A stream of the class batch: of several scenes in one turn the last is the world.
    const newest = Array.isArray(value) ? (value[value.length - 1] ?? null) : value;
    this.scene = newest as unknown as PageScene | null;
    this.poses = new Float32Array(0);
    const { selection, scene } = this;
    if (
      selection &&
      !selection.light &&
      !scene?.models.some((model) => model.name === selection.model)
    )
      this.select(null);
    this.sceneListeners.forEach((listener) => listener());
  }
}
