/** Topic Monitor: types, rates and bandwidths, and the values of the topics that are ticked. */

import type { Channel } from '../channel';
import { isObject, textsOf, type Json, type JsonObject } from '../json';
import type { TopicRow, TopicStats } from '../generated/messages';
import { shortType } from '../graph_store';
import { h, perFrame, setText, spacer, toolbar } from '../widgets/dom';
import { carryField } from '../widgets/field_drag';
import { bandwidth, rate } from '../widgets/format';
import { messageRows, type MessageRow } from '../widgets/message_rows';
import { VirtualList } from '../widgets/virtual_list';
import { BasePanel } from './base';

interface Row {
  topic: TopicRow | null;
  field: MessageRow | null;
  path: string;
}

const LIVE_MS = 100;

/** The Topic Monitor of rqt. */
export class TopicMonitor extends BasePanel {
  readonly title = 'Topic Monitor';
  private readonly ticked = new Map<string, Channel>();
  private readonly messages = new Map<string, Json>();
  private readonly stats = new Map<string, TopicStats>();
  private readonly expanded = new Set<string>();
  private filter = '';
  private statsChannel: Channel | null = null;
  private readonly list: VirtualList<Row>;
  private readonly rebuildSoon = perFrame(() => this.rebuild(), LIVE_MS);
  private readonly rebuild = perFrame(() => {
    if (this.visible) this.list.set(this.rows(), true);
  });
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Filter topics',
    'aria-label': 'Filter topics',
  });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('topics');
    this.list = new VirtualList<Row>({
      height: 24,
      role: 'treegrid',
      label: 'Topics',
      headings: ['Topic', 'Type', 'Bandwidth', 'Hz', 'Value'],
      make: () => this.makeRow(),
      fill: (element, row) => this.fillRow(element, row),
    });
    this.search.addEventListener('input', () => {
      this.filter = this.search.value.toLowerCase();
      this.rebuild();
    });
    const hint = h(
      'span',
      { class: 'dim' },
      'Tick a topic to see its values; drag a value onto a plot',
    );
    this.element.append(toolbar('Topic Monitor', this.search, spacer(), hint), this.list.element);
    this.list.element.addEventListener('click', (event) => this.click(event));
    this.list.element.addEventListener('dragstart', (event) => this.drag(event));
    this.atEnd(this.host.graph.watch(() => this.rebuild()));
  }

  override open(params: JsonObject): void {
    for (const path of textsOf(params, 'expanded')) this.expanded.add(path);
    for (const topic of [...textsOf(params, 'topics'), ...textsOf(params, 'args')]) {
      this.expanded.add(topic);
      this.tick(topic, true);
    }
    this.rebuild();
  }

  override state(): JsonObject {
    return { topics: [...this.ticked.keys()], expanded: [...this.expanded] };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.rebuild();
  }

  private rows(): Row[] {
    const rows: Row[] = [];
    for (const topic of this.host.graph.value.topics) {
      if (topic.hidden || !matches(topic, this.filter)) continue;
      rows.push({ topic, field: null, path: topic.name });
      const message = this.messages.get(topic.name);
      if (message === undefined || !this.expanded.has(topic.name)) continue;
      for (const field of messageRows(message, topic.name, 1, this.expanded))
        rows.push({ topic: null, field, path: field.path });
    }
    return rows;
  }

  private makeRow(): HTMLElement {
    const name = h(
      'span',
      { role: 'gridcell', class: 'tree-cell' },
      h('button', { type: 'button', class: 'twist', 'aria-label': 'Expand' }),
      h('input', { type: 'checkbox', 'aria-label': 'Subscribe' }),
      h('span', { class: 'label' }),
    );
    const cells = ['type', 'number', 'number', 'value'].map((kind) =>
      h('span', { role: 'gridcell', class: kind }),
    );
    return h('div', { class: 'cells' }, name, ...cells);
  }

  private fillRow(element: HTMLElement, row: Row): void {
    const [, , bytes, hz, value] = element.children as unknown as HTMLElement[];
    const on = row.topic !== null && this.ticked.has(row.path);
    const stats = row.topic ? this.stats.get(row.path) : undefined;
    this.fillName(element, row, on);
    setText(bytes, on ? bandwidth(stats?.bytes_per_s) || '–' : '');
    setText(hz, on ? rate(stats?.hz) || '–' : '');
    setText(
      value,
      row.field ? row.field.value : on && !this.messages.has(row.path) ? 'no message yet' : '',
    );
  }

  /** What seldom changes; a row that shows the same field as before is left alone. */
  private fillName(element: HTMLElement, row: Row, on: boolean): void {
    const branch = row.field ? row.field.branch : on;
    const open = row.field ? row.field.expanded : on && this.expanded.has(row.path);
    const depth = row.field?.depth ?? 0;
    const key = [row.path, on, branch, open, row.topic?.type].join(' ');
    if (element.dataset.key === key) return;
    element.dataset.key = key;
    element.dataset.path = row.path;
    const [name, type] = element.children as unknown as HTMLElement[];
    const [twist, tick, label] = name.children as unknown as [
      HTMLElement,
      HTMLInputElement,
      HTMLElement,
    ];
    name.style.paddingLeft = `${4 + depth * 16}px`;
    twist.style.visibility = branch ? 'visible' : 'hidden';
    twist.setAttribute('aria-expanded', String(open));
    tick.hidden = row.topic === null;
    tick.checked = on;
    tick.setAttribute('aria-label', `Subscribe ${row.path}`);
    setText(label, row.field?.name ?? row.path);
    label.title = row.path;
    setText(type, shortType(row.topic?.type ?? ''));
    type.title = row.topic?.type ?? '';
    element.setAttribute('aria-level', String(depth + 1));
    element.draggable = row.topic !== null || branch || (row.field?.numeric ?? false);
    element.classList.toggle('live', on);
  }

  private click(event: MouseEvent): void {
    const row = this.list.rowAt(event.target);
    if (!row || !(event.target instanceof Element)) return;
    if (event.target instanceof HTMLInputElement) {
      delete event.target.closest<HTMLElement>('[data-key]')?.dataset.key;
      if (event.target.checked) this.expanded.add(row.path);
      this.tick(row.path, event.target.checked);
    } else if (event.target.closest('.twist, .label')) {
      if (!this.expanded.delete(row.path)) this.expanded.add(row.path);
    }
    this.host.touched();
    this.rebuild();
  }

  private tick(topic: string, on: boolean): void {
    if (on === this.ticked.has(topic)) return;
    if (on) {
      this.ticked.set(
        topic,
        this.stream(
          'topic.echo',
          { topic, rate_hz: 10 },
          {
            onData: (value) => this.takeMessage(topic, value),
            onFailed: (problem) => {
              this.host.fail(problem);
              this.tick(topic, false);
            },
          },
        ),
      );
    } else {
      this.endStream(this.ticked.get(topic));
      this.ticked.delete(topic);
      this.messages.delete(topic);
      this.stats.delete(topic);
    }
    this.measure();
    this.rebuild();
  }

  private measure(): void {
    const params = { topics: [...this.ticked.keys()] };
    if (this.ticked.size === 0) {
      this.endStream(this.statsChannel);
      this.statsChannel = null;
    } else if (this.statsChannel) {
      this.statsChannel.change(params);
    } else {
      this.statsChannel = this.stream('topic.stats', params, {
        onData: (value) => this.takeStats(value),
      });
    }
  }

  private takeMessage(topic: string, value: Json): void {
    if (isObject(value)) this.messages.set(topic, value.message ?? null);
    this.rebuildSoon();
  }

  private takeStats(value: Json): void {
    if (!Array.isArray(value)) return;
    for (const each of value as unknown as TopicStats[]) this.stats.set(each.topic, each);
    this.rebuildSoon();
  }

  private drag(event: DragEvent): void {
    const row = this.list.rowAt(event.target);
    if (row) carryField(event, row.path);
  }
}

function matches(topic: TopicRow, filter: string): boolean {
  return (
    filter === '' ||
    topic.name.toLowerCase().includes(filter) ||
    topic.type.toLowerCase().includes(filter)
  );
}
