/** Parameters: the ROS 1 parameter store, to read, set and delete. */

import { isObject, textOf, type Json, type JsonObject } from '../json';
import { button, h, setText, spacer, toolbar } from '../widgets/dom';
import { valueFromText } from '../widgets/value_text';
import { VirtualList } from '../widgets/virtual_list';
import { BasePanel } from './base';

interface Row {
  name: string;
  value: Json;
}

/** rosparam as a panel. */
export class Parameters extends BasePanel {
  readonly title = 'Parameters';
  private rows: Row[] = [];
  private readonly list: VirtualList<Row>;
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Filter parameters',
    'aria-label': 'Filter parameters',
  });
  private readonly newName = h('input', {
    type: 'text',
    placeholder: '/name',
    'aria-label': 'Name of a parameter to set',
    class: 'name',
  });
  private readonly newValue = h('input', {
    type: 'text',
    placeholder: 'value',
    'aria-label': 'Value to set',
  });
  private readonly count = h('span', { class: 'dim' });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('parameters');
    this.list = new VirtualList<Row>({
      height: 26,
      label: 'Parameters',
      headings: ['Name', 'Value', 'Delete'],
      make: () => this.makeRow(),
      fill: (element, row) => fill(element, row),
    });
    this.list.element.addEventListener('change', (event) => void this.edit(event));
    this.list.element.addEventListener('click', (event) => void this.click(event));
    this.search.addEventListener('input', () => this.refresh());
    this.element.append(
      toolbar(
        'Parameters',
        this.search,
        this.count,
        spacer(),
        this.newName,
        this.newValue,
        button('Set', () => void this.add(), { icon: 'plus' }),
        button('', () => void this.load(), { icon: 'refresh', title: 'Read again' }),
      ),
      this.list.element,
    );
  }

  override open(params: JsonObject): void {
    this.search.value = textOf(params, 'filter');
    void this.load();
  }

  override state(): JsonObject {
    return { filter: this.search.value };
  }

  private async load(): Promise<void> {
    const list = await this.ask('param.list');
    if (!Array.isArray(list)) return;
    this.rows = list.map((each) =>
      isObject(each)
        ? { name: textOf(each, 'name'), value: each.value ?? null }
        : { name: String(each), value: null },
    );
    this.refresh();
  }

  private refresh(): void {
    const part = this.search.value.toLowerCase();
    const rows = this.rows.filter((row) => row.name.toLowerCase().includes(part));
    setText(this.count, `${rows.length} of ${this.rows.length}`);
    this.list.set(rows);
  }

  private makeRow(): HTMLElement {
    return h(
      'div',
      { class: 'cells' },
      h('span', { role: 'cell', class: 'ellipsis' }),
      h(
        'span',
        { role: 'cell' },
        h('input', { type: 'text', class: 'inline', spellcheck: 'false' }),
      ),
      h(
        'span',
        { role: 'cell' },
        button('', () => undefined, { icon: 'trash', title: 'Delete', class: 'ghost' }),
      ),
    );
  }

  private async edit(event: Event): Promise<void> {
    const row = this.list.rowAt(event.target);
    if (!row || !(event.target instanceof HTMLInputElement)) return;
    await this.ask('param.set', { name: row.name, value: valueFromText(event.target.value) });
    await this.load();
  }

  private async click(event: MouseEvent): Promise<void> {
    const row = this.list.rowAt(event.target);
    if (!row || !(event.target instanceof Element) || !event.target.closest('button')) return;
    await this.ask('param.delete', { name: row.name });
    await this.load();
  }

  private async add(): Promise<void> {
    if (!this.newName.value.trim()) {
      this.host.fail(new Error('No name of a parameter is given.'));
      return;
    }
    const done = await this.ask('param.set', {
      name: this.newName.value.trim(),
      value: valueFromText(this.newValue.value),
    });
    if (done !== null) this.newName.value = this.newValue.value = '';
    await this.load();
  }
}

function fill(element: HTMLElement, row: Row): void {
  const [name, value, remove] = element.children as unknown as HTMLElement[];
  setText(name, row.name);
  name.title = row.name;
  const input = value.firstElementChild as HTMLInputElement;
  input.setAttribute('aria-label', `Value of ${row.name}`);
  if (document.activeElement !== input)
    input.value = typeof row.value === 'string' ? row.value : JSON.stringify(row.value);
  (remove.firstElementChild as HTMLElement).setAttribute('aria-label', `Delete ${row.name}`);
}
