/** The displays of one view, its fixed frame, and how both are saved. */
import type { RvizDisplay, RvizTool } from '../generated/messages';
import { isObject, textOf, type Json, type JsonObject } from '../json';
import { Display, type Stage } from './display';
import { displayKind } from './registry';
import { parseColour } from '../model/materials';
import * as THREE from 'three';

/** The list behind the Displays panel. */
export class DisplayList {
  readonly displays: Display[] = [];
  backgroundColour = '48; 48; 48';
  /** What a `.rviz` file says of tools. */
  tools: readonly RvizTool[] = [];
  /** Of classes that are not known yet. */
  private waiting: readonly RvizDisplay[] = [];
  private readonly listeners = new Set<
    (what: 'list' | 'status' | 'properties', display?: Display) => void
  >();

  constructor(readonly stage: Stage) {
    stage.frames.onRenamed(() => this.chooseFrame());
  }

  get fixedFrame(): string {
    return this.stage.frames.fixed;
  }

  /** Be told of changes. Returns what ends it. */
  watch(listener: (what: 'list' | 'status' | 'properties', display?: Display) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** Add a display of a class; null for one that does not exist. */
  add(className: string, initial: JsonObject = {}, name?: string): Display | null {
    const kind = displayKind(className);
    if (!kind) return null;
    const display = new Display(kind, name ?? this.freeName(kind.name), this.stage, initial);
    display.onChange = (what) => this.tell(what, display);
    this.displays.push(display);
    this.tell('list');
    this.stage.view.invalidate();
    return display;
  }

  remove(display: Display): void {
    this.displays.splice(this.displays.indexOf(display), 1);
    display.dispose();
    this.tell('list');
  }

  setFixedFrame(name: string): void {
    if (name === this.fixedFrame) return;
    this.stage.frames.setFixed(name);
    this.displays.forEach((display) => display.refix());
    this.tell('list');
  }

  setBackground(value: string): void {
    this.backgroundColour = value;
    const [r, g, b] = parseColour(value);
    this.stage.view.scene.background = new THREE.Color(r, g, b);
    this.stage.view.invalidate();
  }

  hold(held: boolean): void {
    this.displays.forEach((display) => display.hold(held));
    this.stage.frames.hold(held);
  }

  /** Take what `rviz.open` answers or a layout kept; tells whether some wait for their class to be known. */
  load(value: JsonObject): boolean {
    [...this.displays].forEach((display) => this.remove(display));
    if (textOf(value, 'fixed_frame')) this.setFixedFrame(textOf(value, 'fixed_frame'));
    this.tools = (Array.isArray(value.tools) ? value.tools : []).filter(
      isObject,
    ) as unknown as RvizTool[];
    // What a world file says of its scene stays.
    if (textOf(value, 'background') && !this.stage.view.lighting.ofWorld)
      this.setBackground(textOf(value, 'background'));
    const displays = Array.isArray(value.displays) ? value.displays : [];
    this.waiting = this.addAll(displays.filter(isObject) as unknown as RvizDisplay[]);
    this.tell('list');
    return this.waiting.length > 0;
  }

  /** Add those that waited; tells which classes are still not known. */
  addWaiting(): string[] {
    const left = this.addAll(this.waiting);
    this.waiting = [];
    this.tell('list');
    return left.map((each) => each.class);
  }

  /** Add displays; returns those of classes that are not known. */
  private addAll(values: readonly RvizDisplay[]): RvizDisplay[] {
    return values.filter((given) => {
      const topic: JsonObject = given.topic ? { Topic: given.topic } : {};
      const display = this.add(
        given.class,
        { ...given.properties, ...topic },
        given.name || undefined,
      );
      if (display && given.enabled === false) display.setEnabled(false);
      return display === null;
    });
  }

  /** What a layout keeps. */
  save(): JsonObject {
    const displays = [
      ...this.displays.map((each) => ({
        class: each.kind.name,
        name: each.name,
        enabled: each.enabled,
        properties: each.props.toObject(),
      })),
      ...this.waiting,
    ];
    const [shown, tools] = [displays, this.tools] as unknown as Json[];
    return {
      fixed_frame: this.fixedFrame,
      frame_chosen: this.chosen,
      background: this.backgroundColour,
      displays: shown,
      tools,
    };
  }

  dispose(): void {
    this.displays.forEach((display) => display.dispose());
    this.displays.length = 0;
    this.stage.frames.dispose();
  }

  private tell(what: 'list' | 'status' | 'properties', display?: Display): void {
    this.listeners.forEach((listener) => listener(what, display));
  }

  private freeName(base: string): string {
    let name = base;
    for (let i = 2; this.displays.some((display) => display.name === name); i++)
      name = `${base} ${i}`;
    return name;
  }

  /** While nobody chose a frame, the root of the tree is the natural one, as soon as it is known. */
  private chooseFrame(): void {
    const { infos, fixed, robotRoot } = this.stage.frames;
    if (this.displays.length === 0 || this.chosen) return this.tell('list');
    const root =
      ['map', 'odom', 'world'].find((name) =>
        infos.some((info) => info.name === name || info.parent === name),
      ) ??
      rootOf(infos) ??
      robotRoot;
    if (root && root !== fixed) this.setFixedFrame(root);
    else this.tell('list');
  }

  /** The person or a file chose the frame: it stays, also while it does not exist. */
  chosen = false;
}

function rootOf(infos: readonly { name: string; parent: string }[]): string | undefined {
  const children = new Set(infos.filter((info) => info.parent).map((info) => info.name));
  return infos.find((info) => !children.has(info.name))?.name ?? infos[0]?.parent;
}
