/** The dock: panels in tabs and splits, shown by name, kept as a layout. */

import {
  createDockview,
  themeDark,
  type DockviewApi,
  type IDockviewPanel,
  type SerializedDockview,
} from 'dockview-core';
import type { Connection } from '../connection';
import type { GraphStore } from '../graph_store';
import { isObject, type Json, type JsonObject } from '../json';
import { findPanel, type Panel, type PanelHost } from '../panel';
import { button, h } from '../widgets/dom';
import { PanelFrame } from './panel_frame';
import { HelpButton, showPanelHelp } from './panel_help';
import { PanelTab } from './panel_tab';
import type { Toasts } from './toasts';

/** Where a panel goes in a default layout. */
export interface Place {
  kind: string;
  params?: JsonObject;
  /** The kind next to which it goes. */
  beside?: string;
  direction?: 'left' | 'right' | 'above' | 'below' | 'within';
  width?: number;
  height?: number;
  /** The group of tabs it goes into. */
  group?: string;
}

/** What part of the page those panels get that commands ask for while others are looked at. */
const BESIDE = 0.4;
const SAVE_AFTER_MS = 400;

/** The dock of the page. */
export class Dock {
  private readonly api: DockviewApi;
  private readonly frames = new Map<string, PanelFrame>();
  private readonly changeListeners = new Set<() => void>();
  private pending = 0;
  /** The group that `showBeside` fills. */
  private besides = '';

  constructor(
    root: HTMLElement,
    private readonly connection: Connection,
    private readonly graph: GraphStore,
    private readonly toasts: Toasts,
  ) {
    this.api = createDockview(root, {
      theme: themeDark,
      defaultRenderer: 'always',
      createComponent: ({ id, name }) => this.createFrame(id, name),
      createTabComponent: () => new PanelTab(),
      defaultTabComponent: 'tab',
      createRightHeaderActionComponent: () => new HelpButton(connection),
      createWatermarkComponent: () => ({ element: this.watermark(), init: () => undefined }),
    });
    this.api.onDidLayoutChange(() => this.touch());
    this.api.onDidRemovePanel((panel) => this.removed(panel));
  }

  /** Opens a panel by its kind's name or alias; one that can only be there once comes to the front. */
  show(name: string, params: JsonObject = {}, place?: Place): void {
    const kind = findPanel(name);
    if (!kind) {
      this.toasts.fail(new Error(`There is no panel named ${name}.`));
      return;
    }
    if (kind.single && this.openIn(kind.kind, params)) return;
    this.api.addPanel({
      id: this.freshId(kind.kind),
      component: kind.kind,
      title: kind.title,
      params: { state: params },
      ...this.position(
        place ?? placeBelow(kind.below && this.has(kind.below) ? kind.below : undefined, kind.kind),
      ),
    });
  }

  /** Width of the dock, pixels. */
  get width(): number {
    return this.api.width;
  }

  /** Whether a panel of a kind is open. */
  has(kind: string): boolean {
    return this.panelOf(kind) !== undefined;
  }

  /** Opens a panel at the right of what is looked at; further ones go into tabs there. */
  showBeside(name: string, params: JsonObject = {}): void {
    const tabs = this.api.getGroup(this.besides);
    const widths = this.api.groups.map((group) => [group, group.width] as const);
    if (this.api.panels.length === 0) return this.show(name, params);
    this.show(
      name,
      params,
      tabs
        ? { kind: name, direction: 'within', group: tabs.id }
        : { kind: name, direction: 'right' },
    );
    const group = this.api.activeGroup;
    this.besides = group?.id ?? '';
    if (tabs || !group) return;
    // The widest one makes room; narrow ones, as trees, stay as they are.
    const widest = widths.reduce((one, other) => (other[1] > one[1] ? other : one))[0];
    for (const [each, width] of widths) if (each !== widest) each.api.setSize({ width });
    group.api.setSize({ width: Math.round(this.api.width * BESIDE) });
  }

  /** Hands parameters to an open panel of a kind and brings it to the front; answers whether there is one. */
  openIn(kind: string, params: JsonObject): boolean {
    const open = this.panelOf(kind);
    const frame = open && this.frames.get(open.id);
    if (!open || !frame) return false;
    open.api.setActive();
    frame.open(params);
    return true;
  }

  /** Puts a default layout in place of what is open. */
  arrange(places: readonly Place[]): void {
    this.api.clear();
    for (const place of places)
      if (findPanel(place.kind)) this.show(place.kind, place.params ?? {}, place);
    // Of panels that share tabs the first is in front, and the layout's first panel has the focus.
    const shared = new Set(
      places.filter((place) => place.direction === 'within').map((place) => place.beside),
    );
    for (const place of places.toReversed())
      if (shared.has(place.kind)) this.panelOf(place.kind)?.api.setActive();
    const first = places[0] && this.panelOf(places[0].kind);
    first?.api.setActive();
  }

  /** The layout with the state of every panel. */
  save(): JsonObject {
    for (const [id, frame] of this.frames) {
      this.api.getPanel(id)?.api.updateParameters({ state: frame.state() });
    }
    return JSON.parse(JSON.stringify(this.api.toJSON())) as JsonObject;
  }

  /** Brings a saved layout back; answers whether it could be read. */
  restore(layout: Json): boolean {
    if (!isObject(layout) || !isObject(layout.grid) || !isObject(layout.panels)) return false;
    try {
      this.api.fromJSON(layout as unknown as SerializedDockview);
      return this.api.panels.length > 0;
    } catch (problem) {
      this.api.clear();
      this.toasts.fail(problem, 'The saved layout cannot be read');
      return false;
    }
  }

  /** Calls back some time after the layout or a panel's state changed. */
  onChange(listener: () => void): void {
    this.changeListeners.add(listener);
  }

  /** Closes the panel with the focus. */
  closeActive(): void {
    this.api.activePanel?.api.close();
  }

  /** Makes the panel with the focus as large as the dock, or small again. */
  maximizeActive(): void {
    const panel = this.api.activePanel;
    if (!panel) return;
    if (panel.api.isMaximized()) panel.api.exitMaximized();
    else panel.api.maximize();
  }

  /** Tells what the panel with the focus is for. */
  helpOnActive(): void {
    const kind = findPanel(this.api.activePanel?.view.contentComponent ?? '');
    if (kind) showPanelHelp(kind, this.connection);
  }

  /** Whether a panel of this kind is all that is open. */
  hasOnly(kind: string): boolean {
    return this.api.panels.length === 1 && this.has(kind);
  }

  /** What is there when the last panel was closed. */
  private watermark(): HTMLElement {
    return h(
      'div',
      { class: 'watermark' },
      h('p', {}, 'No panel is open. The menu Panels (P) has all of them.'),
      button('Start page', () => this.show('start'), { icon: 'home' }),
    );
  }

  private createFrame(id: string, name: string): PanelFrame {
    const frame = new PanelFrame(
      findPanel(name),
      name,
      (host) => this.makePanel(name, host),
      this.hostFor(id),
      this.toasts,
    );
    this.frames.set(id, frame);
    return frame;
  }

  private makePanel(name: string, host: PanelHost): Promise<Panel> {
    const kind = findPanel(name);
    if (!kind) return Promise.reject(new Error(`There is no panel named ${name}.`));
    return kind.make(this.connection, host);
  }

  private hostFor(id: string): PanelHost {
    return {
      id,
      graph: this.graph,
      setTitle: (title) => this.api.getPanel(id)?.api.setTitle(title),
      show: (kind, params, below) =>
        this.show(
          kind,
          params,
          below && this.has(below) ? { kind, beside: below, direction: 'below' } : undefined,
        ),
      fail: (problem, where) => this.toasts.fail(problem, where),
      tell: (text) => this.toasts.tell(text),
      touched: () => this.touch(),
    };
  }

  private removed(panel: IDockviewPanel): void {
    this.frames.get(panel.id)?.end();
    this.frames.delete(panel.id);
  }

  private touch(): void {
    clearTimeout(this.pending);
    this.pending = window.setTimeout(() => {
      for (const listener of this.changeListeners) listener();
    }, SAVE_AFTER_MS);
  }

  private freshId(kind: string): string {
    for (let number = 1; ; number += 1) {
      const id = number === 1 ? kind : `${kind}-${number}`;
      if (!this.api.getPanel(id)) return id;
    }
  }

  private panelOf(kind: string): IDockviewPanel | undefined {
    const name = findPanel(kind)?.kind;
    return this.api.panels.find((panel) => panel.view.contentComponent === name);
  }

  private position(place: Place | undefined): object {
    if (!place) return {};
    const beside = place.beside ? this.panelOf(place.beside) : undefined;
    const reference = beside
      ? { referencePanel: beside.id }
      : place.group
        ? { referenceGroup: place.group }
        : {};
    return {
      ...((beside ?? place.direction)
        ? { position: { ...reference, direction: place.direction ?? 'within' } }
        : {}),
      ...(place.width ? { initialWidth: place.width } : {}),
      ...(place.height ? { initialHeight: place.height } : {}),
    };
  }
}

function placeBelow(beside: string | undefined, kind: string): Place | undefined {
  return beside === undefined ? undefined : { kind, beside, direction: 'below' };
}
