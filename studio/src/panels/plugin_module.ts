/** The ES module of a user's panel: drawing of the user's own beside the widgets. */

import type { Json } from '../json';
import { onTheme, theme } from '../shell/theme';
import { h } from '../widgets/dom';

/** What a module's `mount(element, api)` is given. */
export interface ModuleApi {
  /** The value of a widget. */
  get(widget: string): Json;
  /** Does what a person does: sets a widget's value and calls its callback. */
  set(widget: string, value: Json): Promise<void>;
  /** Calls back at every change of a widget's value. */
  onChange(listener: (widget: string, value: Json) => void): void;
  /** Sends a value to `Panel.on_message`. */
  send(value: Json): Promise<void>;
  /** Calls back with what `Panel.send` gives. */
  onMessage(listener: (value: Json) => void): void;
  /** `dark` or `light`, now and at every change. */
  onTheme(listener: (name: string) => void): void;
}

interface DrawingHost {
  readonly values: ReadonlyMap<string, Json>;
  act(widget: string, value: Json): Promise<void>;
  fail(problem: Json): void;
}

/** The part of a panel that its module fills. */
export class Drawing {
  readonly element = h('div', { class: 'own-drawing', hidden: true });
  /** The module's path; empty without one. */
  source = '';
  private changes: ((widget: string, value: Json) => void)[] = [];
  private messages: ((value: Json) => void)[] = [];
  private ends: (() => void)[] = [];
  private turn = 0;

  constructor(private readonly host: DrawingHost) {}

  /** Loads the module as it is now and lets it draw. */
  async open(): Promise<void> {
    this.close();
    const turn = this.turn;
    if (!this.source) return;
    try {
      // Another address each time: a browser runs a module of one address only once.
      const module: unknown = await import(/* @vite-ignore */ `${this.source}?at=${Date.now()}`);
      const mount = (module as { mount?: unknown }).mount;
      if (typeof mount !== 'function')
        throw new Error('the module exports no function mount(element, api)');
      if (turn !== this.turn) return;
      this.element.hidden = false;
      const end: unknown = mount(this.element, this.api());
      if (typeof end === 'function') this.ends.push(() => void end());
    } catch (problem) {
      this.tell(problem);
    }
  }

  /** A widget has another value. */
  changed(widget: string, value: Json): void {
    for (const listener of this.changes) this.guard(() => listener(widget, value));
  }

  /** The panel's code sent something. */
  message(value: Json): void {
    for (const listener of this.messages) this.guard(() => listener(value));
  }

  /** Takes the drawing away; the function that `mount` returned is called. */
  close(): void {
    this.turn += 1;
    for (const end of this.ends) this.guard(end);
    this.changes = [];
    this.messages = [];
    this.ends = [];
    this.element.replaceChildren();
    this.element.hidden = true;
  }

  private api(): ModuleApi {
    return {
      get: (widget) => this.host.values.get(widget) ?? null,
      set: (widget, value) => this.host.act(widget, value),
      onChange: (listener) => {
        this.changes.push(listener);
      },
      send: (value) => this.host.act('', value),
      onMessage: (listener) => {
        this.messages.push(listener);
      },
      onTheme: (listener) => {
        listener(theme());
        this.ends.push(onTheme(listener));
      },
    };
  }

  private guard(work: () => void): void {
    try {
      work();
    } catch (problem) {
      this.tell(problem);
    }
  }

  private tell(problem: unknown): void {
    const error = problem instanceof Error ? problem : new Error(String(problem));
    this.host.fail({
      text: `${this.source}: ${error.name}: ${error.message}`,
      trace: error.stack ?? '',
    });
  }
}
