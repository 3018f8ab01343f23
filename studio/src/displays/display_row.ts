/** A display in the tree: name, switch, status and properties. */
import { button, h, setText } from '../widgets/dom';
import type { Display } from './display';
import { editor, type Known } from './property_row';
import type { PropertySpec } from './properties';

/** What the tree wants to hear of a row. */
export interface RowHost {
  known: Known;
  chosen(display: Display): void;
  touched(): void;
}

/** The row of one display and what is below it. */
export class DisplayRow {
  readonly element: HTMLElement;
  private readonly head: HTMLElement;
  private readonly light = h('span', { class: 'display-light', 'aria-hidden': 'true' });
  private readonly enabled = h('input', { type: 'checkbox' });
  private readonly name = h('span', { class: 'display-name' });
  private readonly body = h('div', { class: 'display-body', role: 'group' });
  private readonly status = h('div', { class: 'display-statuses' });
  private readonly open = new Set<string>();

  constructor(
    readonly display: Display,
    private readonly host: RowHost,
    expanded: boolean,
  ) {
    const { enabled } = this;
    enabled.setAttribute('aria-label', `Show ${display.name}`);
    enabled.addEventListener('change', () => {
      display.setEnabled(enabled.checked);
      host.touched();
    });
    const twist = button('', () => this.expand(!this.expanded), {
      icon: 'down',
      class: 'ghost display-twist',
      title: `Properties of ${display.name}`,
    });
    this.head = h('div', { class: 'display-head' }, twist, this.light, this.name, enabled);
    this.head.addEventListener('click', () => host.chosen(display));
    this.head.addEventListener('dblclick', () => this.expand(!this.expanded));
    this.element = h(
      'div',
      { class: 'display', role: 'treeitem', tabindex: -1, 'aria-label': display.name },
      this.head,
      this.body,
    );
    setText(this.name, display.name);
    this.expand(expanded);
    this.refreshStatus();
  }

  get expanded(): boolean {
    return !this.body.hidden;
  }

  /** Show or hide the properties. */
  expand(on: boolean): void {
    this.body.hidden = !on;
    this.element.setAttribute('aria-expanded', String(on));
    if (on) this.refreshProperties();
  }

  select(on: boolean): void {
    this.element.setAttribute('aria-selected', String(on));
    this.element.tabIndex = on ? 0 : -1;
  }

  /** The status changed. */
  refreshStatus(): void {
    const { display } = this;
    this.enabled.checked = display.enabled;
    this.light.dataset.level = display.enabled ? display.level : 'off';
    this.element.dataset.level = display.level;
    if (this.body.hidden) return;
    this.status.replaceChildren(
      ...[...display.status].map(([what, line]) =>
        h(
          'div',
          { class: `display-status status-${line.level}` },
          h('span', { class: 'status-what' }, what),
          h('span', {}, line.text),
        ),
      ),
    );
  }

  /** Properties came or changed from outside. */
  refreshProperties(): void {
    if (this.body.hidden) return;
    this.body.replaceChildren(this.status, ...this.rows(this.display.props.specs, ''));
    this.refreshStatus();
  }

  private rows(specs: readonly PropertySpec[], prefix: string): HTMLElement[] {
    const groups = new Map<string, PropertySpec[]>();
    const order: (PropertySpec | string)[] = [];
    for (const spec of specs) {
      const [group, ...deeper] = spec.path.slice(prefix.length).split('/');
      if (!deeper.length) order.push(spec);
      else if (groups.has(group)) groups.get(group)?.push(spec);
      else {
        groups.set(group, [spec]);
        order.push(group);
      }
    }
    return order.map((each) =>
      typeof each === 'string'
        ? this.group(each, groups.get(each) ?? [], prefix)
        : this.row(each, each.path.slice(prefix.length)),
    );
  }

  private group(name: string, specs: readonly PropertySpec[], prefix: string): HTMLElement {
    const path = `${prefix}${name}/`;
    const details = h('details', { class: 'property-group' }, h('summary', {}, name));
    details.open = this.open.has(path);
    const fill = (): void =>
      void (details.childElementCount < 2 && details.append(...this.rows(specs, path)));
    if (details.open) fill();
    details.addEventListener('toggle', () => {
      if (details.open) {
        this.open.add(path);
        fill();
      } else this.open.delete(path);
    });
    return details;
  }

  private row(spec: PropertySpec, name: string): HTMLElement {
    const control = editor(spec, this.display.props.get(spec.path), this.host.known, (value) => {
      this.display.set(spec.path, value);
      this.host.touched();
    });
    return h(
      'div',
      { class: 'property-row', title: spec.about },
      h('span', { class: 'property-name' }, name),
      h('span', { class: 'property-value' }, control),
    );
  }
}
