/** The answer to a plug-in of rqt: which of our widgets stands for each of its own. */

import '../styles/plugins.css';
import type { PortedForm, PortedPlugin, PortedWidget } from '../generated/messages';
import type { JsonObject } from '../json';
import { button, h, notice, spacer, toolbar } from '../widgets/dom';
import { BasePanel } from './base';

/** How a plug-in of rqt becomes a panel. */
export class PortPanel extends BasePanel {
  readonly title: string;
  private readonly body = h('div', { class: 'scroll own-port' });
  private code = '';

  constructor(
    private readonly name: string,
    ...args: ConstructorParameters<typeof BasePanel>
  ) {
    super(...args);
    this.title = name.split('/').pop() ?? name;
    this.element.append(
      toolbar(
        this.title,
        h('span', { class: 'dim' }, 'A plug-in of rqt'),
        spacer(),
        button('Copy the panel', () => void this.copy(), {
          icon: 'save',
          title: 'Copy the Python code',
        }),
      ),
      this.body,
    );
  }

  override open(_params: JsonObject): void {
    void this.load();
  }

  private async load(): Promise<void> {
    try {
      const answer = await this.connection.call('plugin.port', { name: this.name });
      this.fill(answer as unknown as PortedPlugin);
    } catch (problem) {
      this.body.replaceChildren(
        notice(problem instanceof Error ? problem.message : String(problem)),
      );
    }
  }

  private fill({ code, title, text, manifest, source, forms, target }: PortedPlugin): void {
    this.code = code;
    this.host.setTitle(title);
    this.body.replaceChildren(
      h('p', {}, text),
      h('p', { class: 'dim' }, `Listed by ${manifest}${source ? `, written in ${source}` : ''}`),
      ...forms.flatMap((form) => formPart(form)),
      h('h3', {}, `A panel to begin with: ${target}`),
      h(
        'pre',
        { class: 'mono own-code', tabindex: 0, role: 'group', 'aria-label': 'Python code' },
        this.code,
      ),
    );
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

const COLUMNS = ['line', 'qt', 'name', 'ours', 'note'] as const;

function formPart({ file, widgets }: PortedForm): HTMLElement[] {
  const heads = ['Line', 'Widget of Qt', 'Name', 'Ours', ''].map((text) =>
    h('th', { scope: 'col' }, text),
  );
  const rows = widgets.map((widget) => h('tr', {}, ...COLUMNS.map((key) => cell(key, widget))));
  return [
    h('h3', {}, file),
    h(
      'table',
      { class: 'own-table', 'aria-label': 'Widgets' },
      h('thead', {}, h('tr', {}, ...heads)),
      h('tbody', {}, ...rows),
    ),
  ];
}

function cell(key: keyof PortedWidget, widget: PortedWidget): HTMLElement {
  const text = key === 'ours' && !widget.ours ? '–' : String(widget[key]);
  return h('td', { class: key === 'ours' ? 'mono' : '' }, text);
}
