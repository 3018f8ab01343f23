/** Between the dock and a panel: loads its code, tells it when it shows and how large it is. */

import type { GroupPanelPartInitParameters, IContentRenderer } from 'dockview-core';
import { isObject, type JsonObject } from '../json';
import type { Panel, PanelHost, PanelKind } from '../panel';
import { h, notice } from '../widgets/dom';
import type { Toasts } from './toasts';

/** What the dock holds for one panel. */
export class PanelFrame implements IContentRenderer {
  readonly element: HTMLElement;
  private panel: Panel | null = null;
  private kept: JsonObject = {};
  private ended = false;
  private visible = false;
  private size: [number, number] = [0, 0];

  constructor(
    kind: PanelKind | undefined,
    private readonly name: string,
    private readonly make: (host: PanelHost) => Promise<Panel>,
    private readonly host: PanelHost,
    private readonly toasts: Toasts,
  ) {
    this.element = h('section', {
      class: 'frame',
      'aria-label': kind?.title ?? name,
      'data-panel': kind?.kind ?? name,
    });
  }

  /** Called by the dock once the tab is there. */
  init(parameters: GroupPanelPartInitParameters): void {
    const state: unknown = parameters.params.state;
    this.kept = isObject(state) ? state : {};
    this.visible = parameters.api.isVisible;
    parameters.api.onDidVisibilityChange((event) => this.show(event.isVisible));
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.make(this.host).then(
      (panel) => this.take(panel),
      (problem: unknown) => this.broken(problem),
    );
  }

  /** Hands parameters to the panel, now or when its code is there. */
  open(params: JsonObject): void {
    if (this.panel) this.panel.open(params);
    else this.kept = { ...this.kept, ...params };
  }

  /** What a layout keeps of the panel. */
  state(): JsonObject {
    return this.panel ? this.panel.state() : this.kept;
  }

  /** The panel was closed. */
  end(): void {
    this.ended = true;
    this.panel?.dispose();
    this.panel = null;
  }

  private take(panel: Panel): void {
    if (this.ended) {
      panel.dispose();
      return;
    }
    this.panel = panel;
    this.element.replaceChildren(panel.element);
    panel.open(this.kept);
    panel.shown?.(this.visible);
    if (this.size[0] > 0) panel.resized?.(...this.size);
  }

  private broken(problem: unknown): void {
    this.element.replaceChildren(notice(`The panel ${this.name} could not be loaded.`));
    this.toasts.fail(problem, this.name);
  }

  private show(visible: boolean): void {
    this.visible = visible;
    this.panel?.shown?.(visible);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0 || (width === this.size[0] && height === this.size[1])) return;
    this.size = [width, height];
    this.panel?.resized?.(width, height);
  }
}
