/** Topics with their values at the time, and curves of their numbers. */
import { h, setText } from '../widgets/dom';
import { curveColour, Plot } from './plot';
import type { Motion } from './motion';
import { modelTopics, Topic, type Column } from './table';
import type { Recording } from './unpacking';

const MOST_CURVES = 8;
const REFRESH_MS = 80;
/** What is drawn at first, the likeliest one of all fields. */
const FIRST = [/pose\.pose\.position\.[xy]$/, /^linear\.x$/, /^position\.\d/, /^(?!header\.)/];

interface Shown {
  topic: Topic;
  column: Column;
  cell: HTMLElement;
}

/** The page's side. */
export class TopicsPanel {
  readonly element: HTMLElement;
  readonly topics: Topic[];
  readonly plot: Plot;
  private readonly legend = h('ul', { class: 'replay-legend', 'aria-label': 'Curves' });
  private readonly open = new Map<Topic, Shown[]>();
  private readonly boxes = new Map<Column, HTMLInputElement>();
  private chosen: Column[] = [];
  private time_s = 0;
  private last = 0;

  constructor(recording: Recording, motion: Motion, seek: (time_s: number) => void) {
    const models = modelTopics(recording, motion);
    this.topics = [...recording.head.topics.map((one) => new Topic(recording, one)), ...models];
    this.plot = new Plot(recording.head.frames.duration_s, seek);
    this.element = h('div', { class: 'replay-topics' });
    if (!this.topics.length) {
      this.element.append(
        h('p', { class: 'notice' }, 'Nothing moves, and no topics were recorded.'),
      );
      return;
    }
    this.element.append(
      h('h2', {}, 'Curves'),
      this.plot.canvas,
      this.legend,
      h('h2', {}, models.length < this.topics.length ? 'Topics and models' : 'Models'),
      ...this.topics.map((topic) => this.row(topic)),
    );
    this.choose(this.first());
  }

  /** Show the values of a time. */
  look(time_s: number): void {
    this.time_s = time_s;
    this.plot.look(time_s);
    const now = performance.now();
    if (now - this.last < REFRESH_MS) {
      setTimeout(() => this.refresh(), REFRESH_MS);
      return;
    }
    this.refresh();
  }

  private refresh(): void {
    this.last = performance.now();
    for (const shown of this.open.values())
      for (const { topic, column, cell } of shown)
        setText(cell, column.text(topic.rowAt(this.time_s)));
    this.chosen.forEach((column, i) => {
      const value = this.legend.children[i]?.querySelector('output');
      if (value) setText(value, column.text(column.topic.rowAt(this.time_s)));
    });
  }

  private first(): Column[] {
    const numbers = this.topics.flatMap((topic) => topic.columns.filter((one) => one.isNumber));
    for (const pattern of FIRST) {
      const found = numbers.filter((one) => pattern.test(one.name) && varies(one));
      if (found.length) return found.filter((one) => one.topic === found[0].topic).slice(0, 4);
    }
    return [];
  }

  private row(topic: Topic): HTMLElement {
    const details = h(
      'details',
      { class: 'replay-topic', 'data-topic': topic.name },
      h(
        'summary',
        {},
        h('span', { class: 'name' }, topic.name),
        h('span', { class: 'dim' }, `${topic.type} · ${topic.count}`),
      ),
    );
    details.addEventListener('toggle', () => {
      if (details.open && !this.open.has(topic)) this.fill(details, topic);
      if (!details.open) this.open.delete(topic);
      if (!details.open) details.querySelector('table')?.remove();
    });
    return details;
  }

  private fill(details: HTMLElement, topic: Topic): void {
    const body = h('tbody', {});
    const shown = topic.columns.map((column) => {
      const cell = h('td', { class: 'value' });
      body.append(
        h('tr', {}, h('td', {}, this.box(column)), h('th', { scope: 'row' }, column.name), cell),
      );
      return { topic, column, cell };
    });
    details.append(h('table', {}, body));
    this.open.set(topic, shown);
    this.refresh();
  }

  private box(column: Column): HTMLElement | null {
    if (!column.isNumber) return null;
    const input = h('input', {
      type: 'checkbox',
      'aria-label': `Draw ${column.title} as a curve`,
      title: 'Draw as a curve',
      on: { change: () => this.toggle(column) },
    });
    input.checked = this.chosen.includes(column);
    this.boxes.set(column, input);
    return input;
  }

  private toggle(column: Column): void {
    const without = this.chosen.filter((one) => one !== column);
    this.choose(
      without.length < this.chosen.length ? without : [...without, column].slice(-MOST_CURVES),
    );
  }

  private choose(columns: Column[]): void {
    this.chosen = columns;
    for (const [column, box] of this.boxes) box.checked = columns.includes(column);
    this.legend.replaceChildren(
      ...columns.map((column, number) =>
        h(
          'li',
          {},
          h('i', { style: `background: var(--${curveColour(number)})` }),
          h('span', {}, column.title),
          h('output', {}),
          h(
            'button',
            {
              type: 'button',
              class: 'button ghost',
              'aria-label': `Remove the curve of ${column.title}`,
              on: { click: () => this.toggle(column) },
            },
            '×',
          ),
        ),
      ),
    );
    this.plot.set(columns);
    this.refresh();
  }
}

function varies(column: Column): boolean {
  const values = column.series();
  return values.some((value) => Math.abs(value - values[0]) > 1e-6);
}
