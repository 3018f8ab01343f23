/** What a panel is, and the register of the kinds that exist. */

import type { Connection } from './connection';
import type { GraphStore } from './graph_store';
import type { JsonObject } from './json';

/** One panel of the dock. */
export interface Panel {
  /** Unique among the open panels; given by the dock. */
  readonly id: string;
  /** What its tab says; a panel may change it with `PanelHost.setTitle`. */
  readonly title: string;
  /** Fills its tab; the dock puts it into the page and takes it out. */
  readonly element: HTMLElement;
  /** Takes up parameters: those of a command (`rqt_plot /odom`) or a state that was saved. */
  open(params: JsonObject): void;
  /** What a saved layout keeps; `open` of it brings the panel back as it was. */
  state(): JsonObject;
  /** Its tab came to the front or went to the back: hidden panels draw nothing. */
  shown?(visible: boolean): void;
  /** Its size in CSS pixels changed. Called once after it was first shown. */
  resized?(width: number, height: number): void;
  dispose(): void;
}

/** What the dock offers to a panel. */
export interface PanelHost {
  /** The id the panel takes. */
  readonly id: string;
  readonly graph: GraphStore;
  setTitle(title: string): void;
  /** Opens (or brings to the front) another panel; a new one comes below one that is open if asked for. */
  show(kind: string, params: JsonObject, below?: string): void;
  /** Tells the person what went wrong: message, hint and the names that exist. */
  fail(problem: unknown, where?: string): void;
  /** Tells the person something that went well. */
  tell(text: string): void;
  /** The state changed in a way that a saved layout should keep. */
  touched(): void;
}

/** The groups of the menu, in its order. */
export const PANEL_GROUPS = [
  'Simulation',
  'Visualization',
  'Topics',
  'Services',
  'Actions',
  'Introspection',
  'Configuration',
  'Logging',
  'Robot Tools',
  'Plugins',
] as const;
export type PanelGroup = (typeof PANEL_GROUPS)[number];

/** What the `?` of a panel tells. */
export interface PanelHelp {
  /** What it is, by its name in Gazebo, RViz or rqt where it has one. */
  readonly what: string;
  /** What to do first. */
  readonly first: string;
  /** Keys, and what they do; those of the whole page are told by the page. */
  readonly keys: readonly (readonly [string, string])[];
  /** A page of the documentation. */
  readonly docs: string;
}

/** One kind of panel: how it is named, found and made. */
export interface PanelKind {
  /** The command that opens it: `rqt_plot`. */
  readonly kind: string;
  readonly title: string;
  readonly group: PanelGroup;
  /** Other names for it: `rqt_tf_tree` for `view_frames`. */
  readonly aliases?: readonly string[];
  /** The kind below which it goes where that is open, not over what is looked at. */
  readonly below?: string;
  /** Whether there can be only one. */
  readonly single?: boolean;
  /** A short line for the menu's tooltip. */
  readonly about?: string;
  readonly help?: PanelHelp;
  /** What the menu shows at the right; the kind's name otherwise. */
  readonly note?: string;
  /** Greyed in the menu: it opens and tells why it is no panel. */
  readonly faded?: boolean;
  /** Makes one; its code may be loaded now. */
  make(connection: Connection, host: PanelHost): Promise<Panel>;
}

const kinds = new Map<string, PanelKind>();
const names = new Map<string, string>();
const families = new Map<string, (name: string) => PanelKind>();

/** Makes a kind known. A later one of the same name replaces it. */
export function registerPanel(kind: PanelKind): void {
  kinds.set(kind.kind, kind);
  for (const name of [kind.kind, ...(kind.aliases ?? [])]) names.set(name, kind.kind);
}

/** Makes all kinds known whose names begin with a prefix, those that nobody listed yet too. */
export function registerFamily(prefix: string, kindOf: (name: string) => PanelKind): void {
  families.set(prefix, kindOf);
}

const listeners = new Set<() => void>();

/** Calls back when the panels that are known have changed while the page was open. */
export function onPanelsChanged(listener: () => void): void {
  listeners.add(listener);
}

/** Tells everybody who shows the panels. */
export function panelsChanged(): void {
  for (const listener of listeners) listener();
}

/** Takes a kind out of the menu. */
export function forgetPanel(kind: string): void {
  kinds.delete(kind);
}

/** The kind of a name or alias. */
export function findPanel(name: string): PanelKind | undefined {
  const family = [...families].find(([prefix]) => name.startsWith(prefix));
  return kinds.get(names.get(name) ?? name) ?? family?.[1](name);
}

/** All kinds in the order they were registered. */
export function allPanels(): PanelKind[] {
  return [...kinds.values()];
}
