/** The help of a panel: the button at the end of its tabs, and what it opens. */

import type { IGroupHeaderProps, IHeaderActionsRenderer } from 'dockview-core';
import type { Connection } from '../connection';
import { findPanel, type PanelKind } from '../panel';
import { button, h } from '../widgets/dom';
import { openDialog, shortcutList } from './dialog';

/** The button beside a group's tabs: the help of the panel that is in front. */
export class HelpButton implements IHeaderActionsRenderer {
  readonly element: HTMLElement;
  private readonly button: HTMLButtonElement;
  private kind: PanelKind | undefined;
  private end: () => void = () => undefined;

  constructor(private readonly connection: Connection) {
    this.button = button('', () => this.kind && showPanelHelp(this.kind, this.connection), {
      icon: 'help',
      class: 'ghost panel-help',
      title: 'Help',
    });
    this.element = h('div', { class: 'panel-help-place' }, this.button);
  }

  init(parameters: IGroupHeaderProps): void {
    const follow = (): void => {
      const panel = parameters.group.activePanel;
      this.kind = panel ? findPanel(panel.view.contentComponent) : undefined;
      this.button.hidden = !this.kind?.help;
      const text = `Help on ${this.kind?.title ?? ''}`;
      this.button.title = `${text} (F1)`;
      this.button.setAttribute('aria-label', text);
    };
    const changes = parameters.api.onDidActivePanelChange(follow);
    this.end = () => changes.dispose();
    follow();
  }

  dispose(): void {
    this.end();
  }
}

/** Shows the help of a kind of panel. */
export function showPanelHelp(kind: PanelKind, connection: Connection): void {
  const { help } = kind;
  if (!help) return;
  const docs = connection.hello?.docs;
  openDialog(
    kind.title,
    h('p', {}, help.what),
    h('h3', {}, 'First'),
    h('p', {}, help.first),
    ...(help.keys.length ? [h('h3', {}, 'Keys'), shortcutList(help.keys)] : []),
    docs
      ? h(
          'p',
          {},
          h(
            'a',
            { href: `${docs}/${help.docs}`, target: '_blank', rel: 'noopener noreferrer' },
            `More about ${kind.title} in the documentation`,
          ),
        )
      : h('p', { class: 'dim' }, `Documentation: docs/${help.docs}`),
  );
}
