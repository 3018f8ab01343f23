/** One display of the list: its properties, its stream, its status, and what draws it. */
import * as THREE from 'three';
import type { Channel, StatusLevel } from '../channel';
import type { Connection } from '../connection';
import type { Frame } from '../binary_frame';
import type { DisplayRow } from '../generated/messages';
import type { GraphStore } from '../graph_store';
import { isObject, textOf, type Json, type JsonObject } from '../json';
import { place } from '../model/shapes';
import type { Frames } from '../scene/frames';
import type { View } from '../scene/view';
import { Properties, type PropertySpec } from './properties';

/** What a display is drawn with. */
export interface Stage {
  view: View;
  connection: Connection;
  frames: Frames;
  graph: GraphStore;
}

/** What a drawer gets of its display. */
export interface Site extends Stage {
  /** Lies in the fixed frame; `take` and `frame` find it placed at the message's pose. */
  root: THREE.Group;
  props: Properties;
  status(what: string, level: StatusLevel, text: string): void;
  /** A property that came with the data: a namespace, a link. */
  offer(spec: PropertySpec): void;
}

/** Draws what the stream brings. */
export interface Drawer {
  take?(value: JsonObject): void;
  frame?(frame: Frame): void | Promise<void>;
  /** A property changed ('' for all). */
  changed?(path: string): void;
  /** The fixed frame changed or the display was reset. */
  clear(): void;
  shown?(visible: boolean): void;
  dispose?(): void;
  /** What is drawn, for tests and the status. */
  counts?(): Record<string, number>;
}

/** How displays of a class are drawn. */
export interface Drawing {
  properties: readonly PropertySpec[];
  /** The pose of a message is not the place of the root: the drawer handles it. */
  ownPose?: boolean;
  make(site: Site): Drawer;
}

/** Where errors may go by themselves while tf comes up. */
const WAITING = new Set(['Transform', 'URDF', 'Map']);

/** A class of RViz's displays. */
export type DisplayKind = DisplayRow & Drawing;

/** A line of the status. */
export interface StatusLine {
  level: StatusLevel;
  text: string;
}

/** A display in the list. */
export class Display {
  readonly root = new THREE.Group();
  readonly props: Properties;
  readonly status = new Map<string, StatusLine>();
  readonly drawer: Drawer;
  enabled = true;
  /** Called when the list must show something anew. */
  onChange: (what: 'status' | 'properties') => void = () => undefined;
  private channel: Channel | null = null;
  private messages = 0;
  /** Errors that are not called so yet. */
  private readonly early = new Map<string, string>();
  private readonly unwatch: () => void;

  constructor(
    readonly kind: DisplayKind,
    public name: string,
    readonly stage: Stage,
    initial: JsonObject = {},
  ) {
    const topic: PropertySpec[] = kind.types.length
      ? [
          {
            path: 'Topic',
            kind: 'topic',
            value: '',
            about: `A topic of ${kind.types.join(' or ')}.`,
            types: kind.types,
          },
        ]
      : [];
    this.props = new Properties([...topic, ...kind.properties]);
    this.props.fromObject(initial);
    this.root.name = name;
    stage.view.scene.add(this.root);
    this.drawer = kind.make({
      ...stage,
      root: this.root,
      props: this.props,
      status: (what, level, words) => this.tell(what, level, words),
      offer: (spec) => void (this.props.add(spec) && this.onChange('properties')),
    });
    this.unwatch = stage.frames.onRenamed(() => this.callErrors());
    this.drawer.changed?.('');
    this.begin();
  }

  get topic(): string {
    return this.props.text('Topic');
  }

  /** The worst of the status lines. */
  get level(): StatusLevel {
    const levels = [...this.status.values()].map((line) => line.level);
    return levels.includes('error') ? 'error' : levels.includes('warn') ? 'warn' : 'ok';
  }

  setEnabled(enabled: boolean): void {
    if (enabled === this.enabled) return;
    this.enabled = enabled;
    this.root.visible = enabled;
    this.drawer.shown?.(enabled);
    if (enabled) this.begin();
    else this.end();
    this.onChange('status');
    this.stage.view.moved();
  }

  /** Change a property; the drawer and the server are told. */
  set(path: string, value: Json): void {
    this.props.set(path, value);
    if (path === 'Topic') {
      this.drawer.clear();
      this.status.clear();
      this.messages = 0;
      if (!this.channel && this.enabled) this.begin();
      else if (!this.topic) this.end();
      else this.channel?.change(this.params());
    } else if (this.props.specs.find((spec) => spec.path === path)?.server)
      this.channel?.change(this.params());
    this.drawer.changed?.(path);
    this.stage.view.invalidate();
  }

  /** Another fixed frame: everything comes anew. */
  refix(): void {
    this.drawer.clear();
    this.channel?.change(this.params());
    this.stage.view.invalidate();
  }

  hold(held: boolean): void {
    this.channel?.hold(held);
  }

  /** How many of what is drawn. */
  counts(): Record<string, number> {
    return { messages: this.messages, ...this.drawer.counts?.() };
  }

  dispose(): void {
    this.end();
    this.unwatch();
    this.drawer.clear();
    this.drawer.dispose?.();
    this.stage.view.scene.remove(this.root);
    this.stage.view.moved();
  }

  private params(): JsonObject {
    return {
      display: this.kind.name,
      topic: this.topic,
      fixed_frame: this.stage.frames.fixed,
      ...this.props.forServer(),
    };
  }

  private begin(): void {
    if (!this.kind.streams || this.channel) return;
    if (!this.topic) return this.tell('Topic', 'warn', 'No topic is chosen.');
    this.channel = this.stage.connection.open('display', this.params(), {
      onData: (value) => this.take(value),
      onFrame: (frame) => {
        this.count();
        return this.drawer.frame?.(frame);
      },
      onStatus: (level, words) => this.tell('Transform', level, words),
      onFailed: (error) =>
        this.tell('Topic', 'error', [error.message, error.hint].filter(Boolean).join(' ')),
      onEnded: (error) => error && this.tell('Topic', 'error', error.message),
    });
    this.tell('Topic', 'warn', 'No messages received');
  }

  private end(): void {
    this.channel?.close();
    this.channel = null;
  }

  private take(value: Json): void {
    if (!isObject(value)) return;
    this.count();
    const pose = value.pose;
    if (!this.kind.ownPose && 'pose' in value) {
      this.root.visible = this.enabled && pose !== null;
      if (pose === null) {
        this.tell(
          'Transform',
          'error',
          `No transform from [${textOf(value, 'frame')}] to [${this.stage.frames.fixed}]`,
        );
      } else {
        place(this.root, pose as number[]);
        if (this.status.has('Transform')) this.tell('Transform', 'ok', 'Transform OK');
      }
    }
    this.drawer.take?.(value);
    this.stage.view.invalidate();
  }

  private count(): void {
    this.messages += 1;
    this.tell('Topic', 'ok', `${this.messages} messages received`);
  }

  private tell(what: string, level: StatusLevel, words: string): void {
    this.early.delete(what);
    if (level === 'error' && WAITING.has(what) && !this.stage.frames.settled) {
      this.early.set(what, words);
      return this.write(what, 'warn', `Waiting: ${words}`);
    }
    this.write(what, level, words);
  }

  /** What was waited for has not come. */
  private callErrors(): void {
    if (!this.stage.frames.settled) return;
    const late = [...this.early];
    this.early.clear();
    for (const [what, words] of late) this.write(what, 'error', words);
  }

  private write(what: string, level: StatusLevel, words: string): void {
    const old = this.status.get(what);
    if (old?.level === level && old.text === words) return;
    this.status.set(what, { level, text: words });
    this.onChange('status');
  }
}
