/** Logger Level: nodes, their loggers, the level of each. */

import type { LoggerRow } from '../generated/messages';
import { textOf, type JsonObject } from '../json';
import { button, h, roleWhileFilled, notice, toolbar } from '../widgets/dom';
import { BasePanel } from './base';

const LEVELS = ['Debug', 'Info', 'Warn', 'Error', 'Fatal'] as const;

/** rqt_logger_level. */
export class LoggerLevel extends BasePanel {
  readonly title = 'Logger Level';
  private node = '';
  private logger = '';
  private levels = new Map<string, string>();
  private readonly nodes = h('div', {
    class: 'choice-list',
    'aria-label': 'Nodes',
    tabindex: -1,
  });
  private readonly loggers = h('div', {
    class: 'choice-list',
    'aria-label': 'Loggers',
    tabindex: -1,
  });
  private readonly choices = h('div', {
    class: 'choice-list',
    'aria-label': 'Levels',
    tabindex: -1,
  });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    roleWhileFilled(this.nodes, 'listbox');
    roleWhileFilled(this.loggers, 'listbox');
    roleWhileFilled(this.choices, 'listbox');
    this.element.append(
      toolbar(
        'Logger level',
        button('Refresh', () => void this.showLoggers(), { icon: 'refresh' }),
      ),
      h(
        'div',
        { class: 'three-columns' },
        column('Nodes', this.nodes),
        column('Loggers', this.loggers),
        column('Levels', this.choices),
      ),
    );
    this.atEnd(this.host.graph.watch(() => this.showNodes()));
    this.showLevels();
  }

  override open(params: JsonObject): void {
    this.chooseNode(textOf(params, 'node'));
  }

  override state(): JsonObject {
    return { node: this.node };
  }

  private showNodes(): void {
    fill(
      this.nodes,
      this.host.graph.value.nodes.map((node) => node.name),
      this.node,
      (name) => this.chooseNode(name),
    );
  }

  private chooseNode(name: string): void {
    this.node = name;
    this.logger = '';
    this.host.touched();
    this.showNodes();
    void this.showLoggers();
  }

  private async showLoggers(): Promise<void> {
    this.levels = new Map();
    const list = (this.node
      ? await this.ask('logger.list', { node: this.node })
      : null) as unknown as LoggerRow[] | null;
    for (const { name, level } of list ?? []) this.levels.set(name, level);
    if (!this.levels.has(this.logger)) this.logger = [...this.levels.keys()][0] ?? '';
    this.drawLoggers();
    if (this.node && this.levels.size === 0)
      this.loggers.replaceChildren(notice('This node tells of no logger.'));
  }

  private drawLoggers(): void {
    fill(this.loggers, [...this.levels.keys()], this.logger, (name) => {
      this.logger = name;
      this.drawLoggers();
    });
    this.showLevels();
  }

  private showLevels(): void {
    const now = this.levels.get(this.logger);
    fill(
      this.choices,
      [...LEVELS],
      LEVELS.find((level) => level.toLowerCase() === now) ?? '',
      (level) => void this.set(level),
    );
  }

  private async set(level: string): Promise<void> {
    if (!this.logger) return;
    const done = await this.ask('logger.set', {
      node: this.node,
      logger: this.logger,
      level: level.toLowerCase(),
    });
    if (done !== null) await this.showLoggers();
  }
}

function column(title: string, list: HTMLElement): HTMLElement {
  return h('div', { class: 'column' }, h('div', { class: 'column-title' }, title), list);
}

function fill(
  list: HTMLElement,
  names: readonly string[],
  chosen: string,
  choose: (name: string) => void,
): void {
  list.replaceChildren(
    ...names.map((name) =>
      h(
        'button',
        {
          type: 'button',
          class: 'choice',
          role: 'option',
          'aria-selected': String(name === chosen),
          on: { click: () => choose(name) },
        },
        name,
      ),
    ),
  );
}
