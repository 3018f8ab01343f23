/** The answer to a plug-in of rqt: which of our widgets stands for each of its own. */

import '../styles/plugins.css';
import { isObject, textOf, type Json, type JsonObject } from '../json';
import { button, h, notice, spacer, toolbar } from '../widgets/dom';
import { BasePanel } from './base';

/** How a plug-in of rqt becomes a panel. */
export class PortPanel extends BasePanel {
  readonly title: string;
  private readonly body = h('div', { class: 'scroll own-port' });
  private code = '';

  constructor(private readonly name: string, ...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.title = name.split('/').pop() ?? name;
    this.element.append(toolbar(this.title, h('span', { class: 'dim' }, 'A plug-in of rqt'), spacer(),
      button('Copy the panel', () => void this.copy(), { icon: 'save', title: 'Copy the Python code' })), this.body);
  }

  override open(_params: JsonObject): void {
    void this.load();
  }

  private async load(): Promise<void> {
    try {
      const answer = await this.connection.call('plugin.port', { name: this.name });
      if (isObject(answer)) this.fill(answer);
    } catch (problem) {
      this.body.replaceChildren(notice(problem instanceof Error ? problem.message : String(problem)));
    }
  }

  private fill(answer: JsonObject): void {
    this.code = textOf(answer, 'code');
    this.host.setTitle(textOf(answer, 'title', this.title));
    const source = textOf(answer, 'source');
    const forms = Array.isArray(answer['forms']) ? answer['forms'].filter(isObject) : [];
    this.body.replaceChildren(
      h('p', {}, textOf(answer, 'text')),
      h('p', { class: 'dim' }, `Listed by ${textOf(answer, 'manifest')}${source ? `, written in ${source}` : ''}`),
      ...forms.flatMap((form) => formPart(form)),
      h('h3', {}, `A panel to begin with: ${textOf(answer, 'target')}`),
      h('pre', { class: 'mono own-code', tabindex: 0, 'aria-label': 'Python code' }, this.code));
  }

  private async copy(): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.code);
      this.host.tell('The code is copied.');
    } catch (problem) {
      this.host.fail(problem, 'Copying');
    }
  }
}

function formPart(form: JsonObject): HTMLElement[] {
  const widgets = Array.isArray(form['widgets']) ? form['widgets'].filter(isObject) : [];
  const heads = ['Line', 'Widget of Qt', 'Name', 'Ours', ''].map((text) => h('th', { scope: 'col' }, text));
  const rows = widgets.map((widget) => h('tr', {}, ...['line', 'qt', 'name', 'ours', 'note'].map((key) => cell(key, widget[key]))));
  return [
    h('h3', {}, textOf(form, 'file')),
    h('table', { class: 'own-table', 'aria-label': 'Widgets' }, h('thead', {}, h('tr', {}, ...heads)), h('tbody', {}, ...rows)),
  ];
}

function cell(key: string, value: Json): HTMLElement {
  const text = value === '' && key === 'ours' ? '–' : String(value ?? '');
  return h('td', { class: key === 'ours' ? 'mono' : '' }, text);
}
