/** Console: what nodes log, filtered and searched. */

import type { LogLine } from '../generated/messages';
import { textOf, textsOf, type Json, type JsonObject } from '../json';
import { button, h, perFrame, setText, spacer, toggle, toolbar } from '../widgets/dom';
import { download } from '../widgets/download';
import { csvField } from '../widgets/format';
import { cellRow, VirtualList } from '../widgets/virtual_list';
import { BasePanel } from './base';

interface Line {
  number: number;
  stamp_s: number;
  level: string;
  name: string;
  message: string;
  place: string;
}

const LEVELS = ['debug', 'info', 'warn', 'error', 'fatal'] as const;
const TITLES: Record<string, string> = {
  debug: 'Debug',
  info: 'Info',
  warn: 'Warn',
  error: 'Error',
  fatal: 'Fatal',
};
const MOST = 20_000;
const LIVE_MS = 100;

/** rqt_console. */
export class Console extends BasePanel {
  readonly title = 'Console';
  private lines: Line[] = [];
  private shownLines: Line[] = [];
  private readonly hiddenLevels = new Set<string>(['debug']);
  private count = 0;
  private paused = false;
  private highlight = '';
  private node = '';
  private text = '';
  private stale = true;
  private selected: Line | null = null;
  private readonly list: VirtualList<Line>;
  private readonly summary = h('span', { class: 'dim' });
  private readonly details = h('pre', {
    class: 'details mono',
    hidden: true,
    tabindex: 0,
    role: 'group',
    'aria-label': 'Message',
  });
  private readonly controls = h('div', {});
  private readonly refreshSoon = perFrame(() => this.refresh(), LIVE_MS);

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('console');
    this.list = new VirtualList<Line>({
      height: 22,
      label: 'Messages',
      headings: ['Severity', 'Stamp', 'Node', 'Message', 'Location'],
      make: () => cellRow(5),
      fill: (element, line) => this.fill(element, line),
    });
    this.list.element.addEventListener('click', (event) =>
      this.select(this.list.rowAt(event.target) ?? null),
    );
    this.element.append(this.controls, this.list.element, this.details);
    this.showControls();
    this.list.follow(true);
    this.stream('rosout', { level: 'debug' }, { onData: (value) => this.take(value) });
  }

  override open(params: JsonObject): void {
    if (Array.isArray(params.hidden)) {
      this.hiddenLevels.clear();
      for (const level of textsOf(params, 'hidden')) this.hiddenLevels.add(level);
    }
    this.text = textOf(params, 'text', this.text);
    this.node = textOf(params, 'node', this.node);
    this.highlight = textOf(params, 'highlight', this.highlight);
    this.showControls();
    this.refilter();
  }

  override state(): JsonObject {
    return {
      hidden: [...this.hiddenLevels],
      text: this.text,
      node: this.node,
      highlight: this.highlight,
    };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.refresh();
  }

  private showControls(): void {
    const levels = LEVELS.map((level) =>
      toggle(
        TITLES[level],
        !this.hiddenLevels.has(level),
        (on) => {
          if (on) this.hiddenLevels.delete(level);
          else this.hiddenLevels.add(level);
          this.refilter();
        },
        { title: `Show messages of level ${TITLES[level]}`, class: `level level-${level}` },
      ),
    );
    const follow = () => {
      this.list.follow(true);
      this.refresh();
    };
    this.controls.replaceChildren(
      toolbar(
        'Console',
        h('span', { class: 'joined-row', role: 'group', 'aria-label': 'Levels' }, ...levels),
        this.field('text', 'Filter messages'),
        this.field('node', 'Filter nodes'),
        this.field('highlight', 'Highlight'),
        spacer(),
        this.summary,
        toggle(
          'Pause',
          this.paused,
          (on) => {
            this.paused = on;
            this.refresh();
          },
          { icon: 'pause', title: 'Pause' },
        ),
        button('', follow, { icon: 'down', title: 'Go to the newest message' }),
        button('', () => this.clear(), { icon: 'clear', title: 'Clear the messages' }),
        button('CSV', () => this.save(), { icon: 'save', title: 'Save the messages shown as CSV' }),
      ),
    );
  }

  private field(name: 'text' | 'node' | 'highlight', label: string): HTMLInputElement {
    const input = h('input', {
      type: 'search',
      value: this[name],
      placeholder: label,
      'aria-label': label,
    });
    input.addEventListener('input', () => {
      this[name] = input.value;
      this.refilter();
    });
    return input;
  }

  private take(value: Json): void {
    if (!Array.isArray(value)) return;
    for (const item of value as unknown as LogLine[]) this.add(item);
    if (this.lines.length > MOST) {
      this.lines = this.lines.slice(-MOST / 2);
      this.stale = true;
    }
    this.refreshSoon();
  }

  private add(item: LogLine): void {
    this.count += 1;
    const { stamp_s, level, name, message, file } = item;
    const place = file ? `${file.split('/').pop()}:${item.line} ${item.function}` : item.function;
    const line: Line = { number: this.count, stamp_s, level, name, message, place };
    this.lines.push(line);
    if (this.passes(line)) this.shownLines.push(line);
  }

  private passes(line: Line): boolean {
    return (
      !this.hiddenLevels.has(line.level) &&
      line.message.toLowerCase().includes(this.text.toLowerCase()) &&
      line.name.toLowerCase().includes(this.node.toLowerCase())
    );
  }

  private refilter(): void {
    this.stale = true;
    this.host.touched();
    this.refresh();
  }

  private refresh(): void {
    if (!this.visible) return;
    if (this.stale) this.shownLines = this.lines.filter((line) => this.passes(line));
    this.stale = false;
    setText(this.summary, `${this.shownLines.length} of ${this.lines.length}`);
    if (!this.paused) this.list.set(this.shownLines.slice());
  }

  private fill(element: HTMLElement, line: Line): void {
    const [level, stamp, node, message, place] = element.children as unknown as HTMLElement[];
    setText(level, TITLES[line.level] ?? line.level);
    setText(stamp, line.stamp_s.toFixed(3));
    setText(node, line.name);
    setText(message, line.message.replaceAll('\n', ' ⏎ '));
    setText(place, line.place);
    element.dataset.level = line.level;
    const found =
      this.highlight !== '' && line.message.toLowerCase().includes(this.highlight.toLowerCase());
    element.classList.toggle('marked', found);
    element.classList.toggle('chosen', line === this.selected);
  }

  private select(line: Line | null): void {
    this.selected = line === this.selected ? null : line;
    this.details.hidden = this.selected === null;
    if (this.selected)
      setText(
        this.details,
        `${this.selected.name}  ${this.selected.place}\n${this.selected.message}`,
      );
    this.list.refresh();
  }

  private clear(): void {
    this.lines = [];
    this.shownLines = [];
    this.refresh();
  }

  private save(): void {
    const rows = this.shownLines.map((line) =>
      [line.message, line.level, line.name, line.stamp_s.toFixed(9), line.place]
        .map(csvField)
        .join(','),
    );
    download(
      'console.csv',
      ['message,severity,node,stamp,location', ...rows, ''].join('\n'),
      'text/csv',
    );
  }
}
