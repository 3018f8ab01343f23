/** Which layout the page opens with, and the menu that saves, loads and resets layouts. */

import type { Connection } from '../connection';
import type { GraphStore } from '../graph_store';
import { isObject, textOf, type JsonObject } from '../json';
import { findPanel } from '../panel';
import { openMenu, type MenuItem } from '../widgets/menu';
import { askFile, askText } from './dialog';
import type { Dock } from './dock';
import type { LayoutStore } from './layout_store';
import { companionsOf, IDLE, NAMED_LAYOUTS, placesFor, placesForAll } from './layouts';
import type { Toasts } from './toasts';

/** From here on two trees have room beside two views. */
const ROOMY_PX = 1700;

const FIRST_WINDOW_MS = 4000;
const ROSOUT = '/rosout';

/** The layouts of the page. */
export class Layouts {
  private commands: readonly string[] = [];
  private begun = false;
  /** The start page waits for something to run. */
  private isIdle = false;
  private waiting = 0;
  /** Kinds that commands asked for, whose parameters are still to come. */
  private readonly awaited = new Set<string>();

  constructor(
    private readonly connection: Connection,
    private readonly dock: Dock,
    private readonly store: LayoutStore,
    private readonly toasts: Toasts,
    graph: GraphStore,
  ) {
    connection.onHello((hello) => {
      if (!this.begun) this.begin(hello.panels, hello.is_idle);
    });
    connection.onShow((panel, params) => this.show(panel, params));
    dock.onChange(() => {
      // The start page is nobody's layout.
      if (this.begun && !dock.hasOnly('start')) store.keepLast(this.commands, dock.save());
    });
    graph.watch(({ nodes }) => this.takeNodes(nodes.map((node) => node.name)));
  }

  /** The menu of the Layout button. */
  async openMenu(anchor: HTMLElement): Promise<void> {
    const names = await this.store.list();
    const items: MenuItem[] = [
      { text: 'Save layout as…', run: () => void this.saveAs() },
      { text: 'Reset layout', run: () => this.reset() },
      {
        text: 'Open perspective…',
        title: 'A .perspective file of rqt',
        run: () => void this.openPerspective(),
      },
      { text: 'Default layouts', heading: true },
      ...NAMED_LAYOUTS.map(([command, text]) => ({
        text,
        run: () => this.dock.arrange(placesFor(command)),
      })),
    ];
    if (names.length > 0) {
      items.push(
        { text: 'Saved layouts', heading: true },
        ...names.map((name) => ({ text: name, run: () => void this.load(name) })),
      );
      items.push(
        { text: 'Delete', heading: true },
        ...names.map((name) => ({
          text: `Delete ${name}`,
          run: () => void this.store.delete(name),
        })),
      );
    }
    openMenu(anchor, items, 'Layout');
  }

  /** What the page opens with: as this tab was before a reload, or the commands' panels as they were left. */
  private begin(panels: readonly string[], isIdle: boolean): void {
    const asked = new URLSearchParams(location.search).get('panels');
    const wanted = asked ? asked.split(',').filter(Boolean) : panels;
    const kept = wanted.length === 0 ? this.store.tab() : null;
    this.commands = kept?.commands ?? wanted;
    this.isIdle = isIdle && this.commands.length === 0 && !kept;
    if (this.isIdle) this.dock.arrange(IDLE);
    else if (!kept || !this.dock.restore(kept.layout)) this.openAsLast();
    for (const name of panels) this.awaited.add(findPanel(name)?.kind ?? name);
    this.begun = true;
  }

  private openAsLast(): void {
    if (!this.dock.restore(this.store.last(this.commands)))
      this.dock.arrange(placesForAll(this.commands, this.dock.width >= ROOMY_PX));
  }

  /** Something runs now: what it is seen with takes the place of the start page. */
  private takeNodes(names: readonly string[]): void {
    if (!this.isIdle || !this.dock.hasOnly('start')) return;
    if (names.every((name) => name === ROSOUT)) return;
    clearTimeout(this.waiting);
    // A launch that opens windows asks for them a moment later.
    this.waiting = window.setTimeout(() => {
      if (this.isIdle && this.dock.hasOnly('start')) this.openAsLast();
      this.isIdle = false;
    }, FIRST_WINDOW_MS);
  }

  private show(panel: string, params: JsonObject): void {
    const name = textOf(params, 'layout');
    const kind = findPanel(panel)?.kind;
    if (panel === 'layout' && name) void this.load(name);
    else if (panel === 'rqt_gui')
      void this.showPerspective({ path: textOf(params, 'perspective') });
    else if (!kind)
      this.toasts.fail(
        new Error(`A command asks for the panel ${panel}, which this page does not have.`),
      );
    else if (this.isIdle && this.dock.hasOnly('start')) this.showFirst(kind, params);
    else if (!this.awaited.delete(kind) || !this.dock.openIn(kind, params))
      this.showBeside(kind, params);
  }

  /** The first window takes the place of the start page. */
  private showFirst(kind: string, params: JsonObject): void {
    this.isIdle = false;
    clearTimeout(this.waiting);
    this.dock.arrange(placesForAll([kind], this.dock.width >= ROOMY_PX));
    this.dock.openIn(kind, params);
  }

  private showBeside(kind: string, params: JsonObject): void {
    this.dock.showBeside(kind, params);
    for (const place of companionsOf(kind)) {
      if (this.dock.openIn(place.kind, {})) continue;
      const trees = this.dock.has('entities') && this.dock.width < ROOMY_PX;
      this.dock.show(
        place.kind,
        {},
        trees ? { kind: place.kind, beside: 'entities', direction: 'within' } : place,
      );
    }
  }

  private reset(): void {
    this.store.forgetLast(this.commands);
    this.dock.arrange(placesForAll(this.commands, this.dock.width >= ROOMY_PX));
  }

  private async saveAs(): Promise<void> {
    const name = await askText('Save layout', 'Name');
    if (!name) return;
    const where = await this.store.save(name, this.dock.save());
    this.toasts.tell(
      where === 'server'
        ? `Layout ${name} is saved.`
        : `Layout ${name} is saved in this browser only.`,
    );
  }

  private async openPerspective(): Promise<void> {
    const file = await askFile('.perspective');
    if (file) await this.showPerspective({ name: file.name, text: await file.text() });
  }

  /** Panels of an rqt perspective, in place of those that are open; without one the page stays as it is. */
  private async showPerspective(
    file: { path: string } | { name: string; text: string },
  ): Promise<void> {
    const name = 'path' in file ? file.path : file.name;
    if (!name) return;
    try {
      const value = await this.connection.call('perspective.open', file);
      const panels =
        isObject(value) && Array.isArray(value.panels) ? value.panels.filter(isObject) : [];
      this.dock.arrange([]);
      for (const panel of panels)
        this.dock.showBeside(textOf(panel, 'kind'), isObject(panel.params) ? panel.params : {});
    } catch (problem) {
      this.toasts.fail(problem, name);
    }
  }

  private async load(name: string): Promise<void> {
    const layout = await this.store.load(name);
    if (layout === null) this.toasts.fail(new Error(`There is no layout named ${name}.`));
    else this.dock.restore(layout);
  }
}
