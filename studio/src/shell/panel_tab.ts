/** A panel's tab: its title, and a cross for the pointer; keys close it with Delete or Alt+W. */

import type { ITabRenderer, TabPartInitParameters } from 'dockview-core';
import { h, icon, setText } from '../widgets/dom';

/** What the dock puts into a tab, which itself is the one thing there that has the focus. */
export class PanelTab implements ITabRenderer {
  private readonly title = h('span', { class: 'dv-default-tab-content' });
  // A button inside a tab is one that screen readers do not reach.
  private readonly cross = h('span', { class: 'dv-default-tab-action', 'aria-hidden': 'true' });
  readonly element = h('div', { class: 'dv-default-tab' }, this.title, this.cross);

  init({ title, api }: TabPartInitParameters): void {
    setText(this.title, title);
    api.onDidTitleChange((event) => setText(this.title, event.title));
    this.cross.append(icon('close'));
    this.cross.title = 'Close (Alt+W)';
    this.cross.addEventListener('pointerdown', (event) => event.preventDefault());
    this.cross.addEventListener('click', (event) => {
      event.preventDefault();
      api.close();
    });
    // The tab is the dock's own element around this one.
    queueMicrotask(() =>
      this.element.closest('[role=tab]')?.addEventListener('keydown', (event) => {
        if ((event as KeyboardEvent).key === 'Delete') api.close();
      }),
    );
  }
}
