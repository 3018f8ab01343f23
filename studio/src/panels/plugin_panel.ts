/** A panel of the user's own: draws the widgets that its Python class lists. */

import { serverPath } from '../server_path';
import '../styles/plugins.css';
import type { Channel } from '../channel';
import { inOneLine } from '../errors';
import type { Frame } from '../binary_frame';
import type { PanelEvent, PanelInfo, PanelState } from '../generated/messages';
import { isObject, numberOf, textOf, type Json, type JsonObject } from '../json';
import { button, h, notice, setText, spacer, toolbar } from '../widgets/dom';
import { controlFor, type WidgetView } from '../widgets/plugin_controls';
import { viewFor, type ViewHost } from '../widgets/plugin_views';
import { BasePanel } from './base';
import { Drawing } from './plugin_module';

interface Shown {
  spec: JsonObject;
  view: WidgetView;
}

/** A panel of a Python class. */
export class PluginPanel extends BasePanel implements ViewHost {
  readonly base: string;
  readonly title: string;
  private readonly values = new Map<string, Json>();
  private readonly widgets = new Map<string, Shown>();
  private readonly file = h('span', { class: 'dim ellipsis' });
  private readonly again = button('Reload', () => void this.reload(), {
    icon: 'refresh',
    title: 'Read the file again and begin anew',
  });
  private readonly problem = h('div', { class: 'own-problem', role: 'alert', hidden: true });
  private readonly body = h('div', { class: 'own-body' });
  private readonly drawing: Drawing;
  private begun = false;

  constructor(
    private readonly name: string,
    ...args: ConstructorParameters<typeof BasePanel>
  ) {
    super(...args);
    this.title = name.split('.').pop() ?? name;
    this.base = serverPath(`/plugin/${encodeURIComponent(name)}/`);
    this.drawing = new Drawing({
      values: this.values,
      act: (widget, value) => this.act(widget, value),
      fail: (problem) => this.showProblem(problem),
    });
    this.element.classList.add('own-panel');
    this.element.append(
      toolbar(this.title, this.file, spacer(), this.again),
      this.problem,
      h('div', { class: 'scroll own-scroll' }, this.body, this.drawing.element),
    );
    this.atEnd(() => {
      this.clear();
      this.drawing.close();
    });
  }

  override open(_params: JsonObject): void {
    if (this.begun) return;
    this.begun = true;
    this.stream(
      'plugin',
      { name: this.name },
      {
        onOpened: (info) => this.opened(info as unknown as PanelInfo),
        onData: (events) => this.take(events),
        onFailed: (problem) => this.failed(inOneLine(problem)),
      },
    );
  }

  /** Pictures of a topic, for the widget `Image`. */
  pictures(
    topic: string,
    draw: (frame: Frame) => Promise<void>,
    tell: (text: string) => void,
  ): () => void {
    const channel: Channel = this.stream(
      'image',
      { topic },
      {
        onFrame: draw,
        onStatus: (_level, text) => tell(text),
        onFailed: (problem) => tell(inOneLine(problem)),
      },
    );
    return () => this.endStream(channel);
  }

  private opened({ title, file, module }: PanelInfo): void {
    this.host.setTitle(title);
    setText(this.file, file.split('/').pop() ?? '');
    this.file.title = file;
    this.drawing.source = module ? serverPath(module) : '';
  }

  private failed(text: string): void {
    this.clear();
    this.body.replaceChildren(notice(text));
  }

  private take(events: Json): void {
    for (const { what, name, value } of events as unknown as PanelEvent[])
      this.happen(what, name, value);
  }

  private happen(what: string, name: string, value: Json): void {
    switch (what) {
      case 'state':
        return this.rebuild(value as unknown as PanelState);
      case 'set':
        return this.set(name, value);
      case 'add':
        return this.widgets.get(name)?.view.add?.([value]);
      case 'widget':
        return isObject(value) ? this.replace(name, value) : undefined;
      case 'error':
        return this.showProblem(value);
      case 'message':
        return this.drawing.message(value);
      case 'changed':
        return this.markChanged(true);
    }
  }

  private rebuild({ layout, values, points }: PanelState): void {
    this.clear();
    this.markChanged(false);
    this.body.replaceChildren(...this.parts(layout));
    for (const [name, value] of Object.entries(values)) this.set(name, value);
    for (const [name, list] of Object.entries(points)) this.widgets.get(name)?.view.add?.(list);
    void this.drawing.open();
  }

  private parts(layout: Json | undefined): HTMLElement[] {
    return Array.isArray(layout) ? layout.filter(isObject).map((part) => this.part(part)) : [];
  }

  private part(spec: JsonObject): HTMLElement {
    const kind = textOf(spec, 'kind');
    if (kind !== 'row' && kind !== 'column') return this.widget(spec);
    const title = textOf(spec, 'title');
    const inside = h('div', { class: `own-${kind}` }, ...this.parts(spec.children));
    if (!title) return inside;
    return h('section', { class: 'own-group', 'aria-label': title }, h('h3', {}, title), inside);
  }

  private widget(spec: JsonObject): HTMLElement {
    const name = textOf(spec, 'name');
    const view = controlFor(spec, (value) => this.act(name, value)) ?? viewFor(spec, this);
    if (!view) return notice(`This page does not know widgets of kind ${textOf(spec, 'kind')}.`);
    view.element.dataset.widget = name;
    this.widgets.set(name, { spec, view });
    enable(view.element, spec);
    return view.element;
  }

  private replace(name: string, spec: JsonObject): void {
    const old = this.widgets.get(name);
    if (!old) return;
    if (sameBut(old.spec, spec)) {
      old.spec = spec;
      enable(old.view.element, spec);
      return;
    }
    old.view.dispose?.();
    old.view.element.replaceWith(this.widget(spec));
    this.set(name, this.values.get(name) ?? null);
  }

  private set(name: string, value: Json): void {
    this.values.set(name, value);
    this.widgets.get(name)?.view.show(value);
    this.drawing.changed(name, value);
  }

  /** Never keeps an act for later: a button that was pressed without a connection does nothing. */
  private async act(widget: string, value: Json): Promise<void> {
    try {
      if (this.connection.state !== 'open')
        throw new Error('There is no connection to the server.');
      await this.connection.call('plugin.event', { name: this.name, widget, value });
    } catch (problem) {
      this.host.fail(problem, this.title);
      setTimeout(() => this.widgets.get(widget)?.view.show(this.values.get(widget) ?? null));
    }
  }

  private async reload(): Promise<void> {
    this.again.disabled = true;
    await this.ask('plugin.reload', { name: this.name });
    this.again.disabled = false;
  }

  private markChanged(changed: boolean): void {
    this.again.classList.toggle('primary', changed);
    setText(
      this.again.querySelector('span') ?? this.again,
      changed ? 'File changed: reload' : 'Reload',
    );
  }

  private showProblem(problem: Json): void {
    this.problem.hidden = !isObject(problem);
    if (!isObject(problem)) return;
    const count = numberOf(problem, 'count', 1);
    const trace = textOf(problem, 'trace');
    this.problem.replaceChildren(
      h(
        'div',
        { class: 'own-problem-text' },
        textOf(problem, 'text') + (count > 1 ? ` (${count} times)` : ''),
      ),
      button(
        '',
        () => {
          this.problem.hidden = true;
        },
        { icon: 'close', title: 'Dismiss', class: 'ghost' },
      ),
      ...(trace
        ? [h('details', {}, h('summary', {}, 'Traceback'), h('pre', { class: 'mono' }, trace))]
        : []),
    );
  }

  private clear(): void {
    for (const { view } of this.widgets.values()) view.dispose?.();
    this.widgets.clear();
    this.values.clear();
    this.body.replaceChildren();
  }
}

function enable(element: HTMLElement, spec: JsonObject): void {
  element.hidden = spec.hidden === true;
  const controls = element.querySelectorAll<
    HTMLInputElement | HTMLButtonElement | HTMLSelectElement
  >('input, button, select');
  for (const control of controls) control.disabled = spec.enabled === false;
}

/** Whether two widgets differ in nothing but whether they are enabled and in sight. */
function sameBut(one: JsonObject, other: JsonObject): boolean {
  const plain = (spec: JsonObject) => JSON.stringify({ ...spec, enabled: null, hidden: null });
  return plain(one) === plain(other);
}
