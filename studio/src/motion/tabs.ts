/** Tabs inside a panel: one row of names, arrow keys go from one to the next. */
import { h } from '../widgets/dom';

/** What stands behind one tab. */
export interface TabPage {
  name: string;
  element: HTMLElement;
  shown?: (visible: boolean) => void;
}

/** The row and the pages below it. */
export class Tabs {
  readonly element = h('div', { class: 'motion-tabs' });
  private readonly buttons: HTMLButtonElement[];
  private chosen = 0;

  constructor(
    label: string,
    private readonly pages: readonly TabPage[],
    private readonly changed: () => void,
  ) {
    this.buttons = pages.map((page, at) =>
      h(
        'button',
        {
          type: 'button',
          class: 'button',
          role: 'tab',
          on: { click: () => this.choose(at), keydown: (event) => this.key(event) },
        },
        page.name,
      ),
    );
    const row = h(
      'div',
      { class: 'add-tabs motion-tab-row', role: 'tablist', 'aria-label': label },
      ...this.buttons,
    );
    for (const page of pages) {
      page.element.setAttribute('role', 'tabpanel');
      page.element.setAttribute('aria-label', page.name);
    }
    this.element.append(row, ...pages.map((page) => page.element));
    this.choose(0);
  }

  get name(): string {
    return this.pages[this.chosen].name;
  }

  /** Bring a page to the front. */
  show(name: string): void {
    const at = this.pages.findIndex((page) => page.name === name);
    if (at >= 0) this.choose(at);
  }

  private choose(at: number): void {
    this.chosen = at;
    this.pages.forEach((page, index) => {
      page.element.hidden = index !== at;
      this.buttons[index].setAttribute('aria-selected', String(index === at));
      this.buttons[index].tabIndex = index === at ? 0 : -1;
      page.shown?.(index === at);
    });
    this.changed();
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = (this.chosen + step + this.pages.length) % this.pages.length;
    this.choose(next);
    this.buttons[next].focus();
  }
}
