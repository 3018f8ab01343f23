/** Nodes: what each node publishes, subscribes to and serves, its process, and an end to it. */

import type { EndpointRow, NodeInfo } from '../generated/messages';
import { textOf, type JsonObject } from '../json';
import { confirmDanger } from '../shell/dialog';
import { button, h, roleWhileFilled, notice, spacer, toolbar } from '../widgets/dom';
import { BasePanel } from './base';

const LISTS = [
  ['publications', 'Publications'],
  ['subscriptions', 'Subscriptions'],
  ['services', 'Services'],
  ['clients', 'Service clients'],
  ['action_servers', 'Action servers'],
  ['action_clients', 'Action clients'],
] as const;

/** rosnode as a panel. */
export class Nodes extends BasePanel {
  readonly title = 'Nodes';
  private node = '';
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Filter nodes',
    'aria-label': 'Filter nodes',
  });
  private readonly list = h('div', {
    class: 'choice-list',
    'aria-label': 'Nodes',
  });
  private readonly body = h('div', { class: 'scroll node-info' }, notice('Choose a node.'));

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    roleWhileFilled(this.list, 'listbox');
    this.search.addEventListener('input', () => this.showList());
    this.element.append(
      h(
        'div',
        { class: 'side-by-side' },
        h('div', { class: 'side' }, toolbar('Nodes', this.search), this.list),
        this.body,
      ),
    );
    this.atEnd(
      this.host.graph.watch(() => {
        this.showList();
        void this.read();
      }),
    );
  }

  override open(params: JsonObject): void {
    this.choose(textOf(params, 'node'));
  }

  override state(): JsonObject {
    return { node: this.node };
  }

  private showList(): void {
    const part = this.search.value.toLowerCase();
    const names = this.host.graph.value.nodes
      .map((node) => node.name)
      .filter((name) => name.toLowerCase().includes(part));
    this.list.replaceChildren(
      ...names.map((name) =>
        h(
          'button',
          {
            type: 'button',
            class: 'choice',
            role: 'option',
            'aria-selected': String(name === this.node),
            on: { click: () => this.choose(name) },
          },
          name,
        ),
      ),
    );
  }

  private choose(node: string): void {
    this.node = node;
    this.host.touched();
    this.showList();
    void this.read();
  }

  private async read(): Promise<void> {
    const { node } = this;
    if (!node || !this.visible) return;
    const info = (await this.connection
      .call('node.info', { node })
      .catch(() => null)) as unknown as NodeInfo | null;
    if (node !== this.node) return;
    if (info) this.show(info);
    else this.body.replaceChildren(notice(`${node} is not there any more.`));
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    void this.read();
  }

  private show(info: NodeInfo): void {
    const process = [info.pid ? `process ${info.pid}` : '', info.host].filter(Boolean).join(' on ');
    this.body.replaceChildren(
      toolbar(
        `Node ${this.node}`,
        h('strong', {}, this.node),
        h('span', { class: 'dim' }, process),
        spacer(),
        button('Kill', () => void this.kill(), {
          icon: 'stop',
          title: `Ask ${this.node} to shut down`,
        }),
      ),
      ...LISTS.flatMap(([name, title]) => section(title, info[name])),
    );
  }

  private async kill(): Promise<void> {
    const { node } = this;
    if (!(await confirmDanger('Kill node', `${node} will be asked to shut down.`, 'Kill'))) return;
    const answer = await this.ask('node.kill', { node });
    if (answer !== null) this.host.tell(`${node} was asked to shut down.`);
  }
}

function section(title: string, rows: readonly EndpointRow[]): HTMLElement[] {
  if (rows.length === 0) return [];
  const items = rows.map(({ name, type }) =>
    h('li', {}, name, h('span', { class: 'dim' }, ` ${type}`)),
  );
  return [h('h3', {}, `${title} (${rows.length})`), h('ul', {}, ...items)];
}
