/** Message, Service and Action Type Browser: packages, types, their definitions. */

import { isObject, textOf, textsOf, type Json, type JsonObject } from '../json';
import { h, notice, setText, toolbar } from '../widgets/dom';
import { VirtualList } from '../widgets/virtual_list';
import { BasePanel } from './base';

type Kind = 'msg' | 'srv' | 'action';

/** rqt_msg, rqt_srv and rqt_action. */
export class TypeBrowser extends BasePanel {
  private names: string[] = [];
  private chosen = '';
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Filter types',
    'aria-label': 'Filter types',
  });
  private readonly list: VirtualList<string>;
  private readonly fields = h('div', { class: 'scroll half type-tree' }, notice('Choose a type.'));
  private readonly text = h('pre', {
    class: 'scroll half mono',
    tabindex: 0,
    role: 'group',
    'aria-label': 'Definition',
  });

  constructor(
    readonly title: string,
    private readonly kind: Kind,
    ...args: ConstructorParameters<typeof BasePanel>
  ) {
    super(...args);
    this.list = new VirtualList<string>({
      height: 22,
      role: 'listbox',
      label: title,
      make: () => h('div', { class: 'choice' }),
      fill: (element, name) => this.fill(element, name),
    });
    this.list.element.classList.add('type-list');
    this.list.element.addEventListener(
      'click',
      (event) => void this.choose(this.list.rowAt(event.target) ?? ''),
    );
    this.list.element.addEventListener('keydown', (event) => this.key(event));
    this.search.addEventListener('input', () => this.refresh());
    this.element.append(
      toolbar(title, this.search),
      h('div', { class: 'halves' }, this.list.element, this.fields, this.text),
    );
    void this.load();
  }

  override open(params: JsonObject): void {
    const type = textOf(params, 'type') || textsOf(params, 'args')[0];
    if (type) void this.choose(type);
  }

  override state(): JsonObject {
    return { type: this.chosen };
  }

  private async load(): Promise<void> {
    const names = await this.ask('type.list', { kind: this.kind });
    this.names = Array.isArray(names) ? names.map(String) : [];
    this.refresh();
  }

  private matching(): string[] {
    const part = this.search.value.toLowerCase();
    return this.names.filter((name) => name.toLowerCase().includes(part));
  }

  private refresh(): void {
    this.list.set(this.matching());
  }

  private fill(element: HTMLElement, name: string): void {
    setText(element, name);
    element.setAttribute('aria-selected', String(name === this.chosen));
  }

  private key(event: KeyboardEvent): void {
    const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    const names = this.matching();
    const at = Math.min(names.length - 1, Math.max(0, names.indexOf(this.chosen) + step));
    void this.choose(names[at] ?? '');
    this.list.reveal(at);
  }

  private async choose(name: string): Promise<void> {
    if (!name) return;
    this.chosen = name;
    this.list.refresh();
    this.host.touched();
    const type = await this.ask('type.get', { type: name, kind: this.kind });
    if (name !== this.chosen || !isObject(type)) return;
    this.fields.replaceChildren(...rows(type.fields ?? []));
    setText(this.text, textOf(type, 'text'));
  }
}

function rows(fields: Json): HTMLElement[] {
  if (!Array.isArray(fields)) return [];
  return fields.filter(isObject).map((field) => {
    const array =
      field.array === null ? '' : typeof field.array === 'number' ? `[${field.array}]` : '[]';
    const line = [
      h('span', { class: 'form-name' }, textOf(field, 'name')),
      h('span', { class: 'form-type' }, `${textOf(field, 'type')}${array}`),
    ];
    if (!Array.isArray(field.fields)) return h('div', { class: 'type-row' }, ...line);
    return h(
      'details',
      { open: field.array === null },
      h('summary', {}, ...line),
      h('div', { class: 'form-inside' }, ...rows(field.fields)),
    );
  });
}
