/** Dynamic Reconfigure: parameters of running nodes with sliders, ticks and choices, live. */

import { isObject, textOf, textsOf, type Json, type JsonObject } from '../json';
import { button, h, notice, roleWhileFilled, toolbar } from '../widgets/dom';
import { valueControl, type ValueControl } from '../widgets/value_control';
import { BasePanel } from './base';
import { readGroups, readNodeParameters, type ParameterGroup } from './reconfigure_groups';

const READ_EVERY_MS = 1000;
const SEND_EVERY_MS = 60;
const LIST_SERVICE = '/list_parameters';

/** rqt_reconfigure, for dynamic_reconfigure of ROS 1 and parameters of ROS 2 nodes. */
export class Reconfigure extends BasePanel {
  readonly title = 'Dynamic Reconfigure';
  private node = '';
  private dynamic: string[] = [];
  private controls = new Map<string, ValueControl>();
  private waiting = new Map<string, Json>();
  private timer = 0;
  private readonly nodes = h('div', {
    class: 'choice-list',
    'aria-label': 'Nodes',
  });
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Filter nodes',
    'aria-label': 'Filter nodes',
  });
  private readonly body = h('div', { class: 'scroll params' }, notice('Choose a node.'));

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('reconfigure');
    roleWhileFilled(this.nodes, 'listbox');
    this.search.addEventListener('input', () => this.showNodes());
    this.element.append(
      h(
        'div',
        { class: 'side-by-side' },
        h(
          'div',
          { class: 'side' },
          toolbar(
            'Nodes',
            this.search,
            button('', () => void this.list(), { icon: 'refresh', title: 'Look for nodes again' }),
          ),
          this.nodes,
        ),
        this.body,
      ),
    );
    this.atEnd(this.host.graph.watch(() => void this.list()));
    const poll = setInterval(() => {
      if (this.visible && this.node) void this.read();
    }, READ_EVERY_MS);
    this.atEnd(() => clearInterval(poll));
    this.atEnd(() => clearTimeout(this.timer));
  }

  override open(params: JsonObject): void {
    const node = textOf(params, 'node') || textsOf(params, 'args')[0];
    if (node) void this.choose(node);
  }

  override state(): JsonObject {
    return { node: this.node };
  }

  private async list(): Promise<void> {
    const names = await this.connection.call('reconfigure.list').catch(() => []);
    this.dynamic = Array.isArray(names)
      ? names.map((each) =>
          isObject(each) ? textOf(each, 'node') || textOf(each, 'name') : String(each),
        )
      : [];
    this.showNodes();
  }

  private names(): string[] {
    const withService = this.host.graph.value.nodes
      .filter((node) => node.serves.some((name) => name === node.name + LIST_SERVICE))
      .map((node) => node.name);
    const part = this.search.value.toLowerCase();
    return [...new Set([...this.dynamic, ...withService])]
      .sort()
      .filter((name) => name.toLowerCase().includes(part));
  }

  private showNodes(): void {
    const names = this.names();
    this.nodes.replaceChildren(
      ...names.map((name) =>
        h(
          'button',
          {
            type: 'button',
            class: 'choice',
            role: 'option',
            'aria-selected': String(name === this.node),
            on: { click: () => void this.choose(name) },
          },
          name,
        ),
      ),
    );
    if (names.length === 0)
      this.nodes.append(notice('No node has parameters that can be set while it runs.'));
    if (this.node && this.controls.size === 0 && names.includes(this.node)) void this.build();
  }

  private async choose(node: string): Promise<void> {
    this.node = node;
    this.host.touched();
    this.showNodes();
    await this.build();
  }

  private groups(): Promise<ParameterGroup[]> {
    if (this.dynamic.includes(this.node))
      return this.connection.call('reconfigure.get', { node: this.node }).then(readGroups);
    return this.connection.call('node.params', { node: this.node }).then(readNodeParameters);
  }

  private async build(): Promise<void> {
    const { node } = this;
    this.controls = new Map();
    try {
      const groups = await this.groups();
      if (node !== this.node) return;
      this.body.replaceChildren(
        h('h3', { class: 'param-node' }, node),
        ...groups.map((group) => this.group(group)),
      );
    } catch (problem) {
      this.body.replaceChildren(notice(`${node} does not tell its parameters now.`));
      if (this.names().includes(node)) this.host.fail(problem, node);
    }
  }

  private group(group: ParameterGroup): HTMLElement {
    const rows = group.parameters.map((spec) => {
      const control = valueControl(spec, (value) => this.want(spec.name, value));
      this.controls.set(spec.name, control);
      return control.element;
    });
    if (!group.name || group.name === 'Default') return h('div', { class: 'param-group' }, ...rows);
    return h(
      'details',
      { class: 'param-group', open: true },
      h('summary', {}, group.name),
      ...rows,
    );
  }

  /** Sliders move faster than nodes answer: the newest value of each goes at a steady pace. */
  private want(name: string, value: Json): void {
    this.waiting.set(name, value);
    if (this.timer) return;
    this.timer = window.setTimeout(() => void this.send(), SEND_EVERY_MS);
  }

  private async send(): Promise<void> {
    const values = Object.fromEntries(this.waiting);
    this.waiting = new Map();
    try {
      if (this.dynamic.includes(this.node))
        this.show(await this.connection.call('reconfigure.set', { node: this.node, values }));
      else await this.sendEach(values);
    } catch (problem) {
      this.host.fail(problem, this.node);
    }
    this.timer = 0;
    if (this.waiting.size > 0)
      this.timer = window.setTimeout(() => void this.send(), SEND_EVERY_MS);
    else await this.read();
  }

  private async sendEach(values: JsonObject): Promise<void> {
    for (const [name, value] of Object.entries(values)) {
      const answer = await this.connection.call('node.param_set', { node: this.node, name, value });
      if (isObject(answer) && answer.successful === false) {
        this.host.fail(
          new Error(
            textOf(answer, 'reason') || `${this.node} refuses ${name} = ${JSON.stringify(value)}.`,
          ),
        );
      }
    }
  }

  private async read(): Promise<void> {
    const groups = await this.groups().catch(() => []);
    if (this.waiting.size > 0 || this.timer) return;
    for (const group of groups)
      for (const spec of group.parameters) this.controls.get(spec.name)?.show(spec.value);
  }

  private show(values: Json): void {
    if (!isObject(values) || this.waiting.size > 0) return;
    for (const [name, value] of Object.entries(values)) this.controls.get(name)?.show(value);
  }
}
