/** Long lists of equal rows: only the rows in sight are in the page. */

import { h, perFrame } from './dom';

/** How rows are made once and filled often. */
export interface RowMaker<T> {
  /** Height of a row, CSS pixels. */
  height: number;
  /** The role of the list: `table` unless told; rows get the role that fits. */
  role?: 'table' | 'treegrid' | 'listbox';
  label: string;
  /** Above the rows; `--columns` is the CSS grid template that they share with rows of class `cells`. */
  headings?: readonly string[];
  make(): HTMLElement;
  fill(element: HTMLElement, row: T, index: number): void;
}

const BEYOND = 4;

/** A scrolling list. */
export class VirtualList<T> {
  readonly element: HTMLElement;
  /** What scrolls: all of it, but for the headings. */
  private readonly scroller: HTMLElement;
  private readonly canvas = h('div', { class: 'rows', role: 'presentation' });
  private readonly pool: HTMLElement[] = [];
  /** What each element shows: a click means that row, even if the list has changed since. */
  private readonly shown = new WeakMap<HTMLElement, T>();
  private rows: readonly T[] = [];
  private stick = false;
  readonly refresh = perFrame(() => this.draw());

  constructor(private readonly maker: RowMaker<T>) {
    const role = maker.role ?? 'table';
    if (maker.headings) {
      const inner = { class: 'virtual', role: 'rowgroup', 'aria-label': maker.label, tabindex: 0 };
      this.scroller = h('div', inner, this.canvas);
      const outer = { class: 'virtual-table', role, 'aria-label': maker.label };
      this.element = h('div', outer, headings(maker.headings), this.scroller);
    } else {
      const whole = { class: 'virtual', role, 'aria-label': maker.label, tabindex: 0 };
      this.element = this.scroller = h('div', whole, this.canvas);
    }
    this.scroller.addEventListener(
      'scroll',
      () => {
        this.stick = this.stick && this.atEnd();
        this.refresh();
      },
      { passive: true },
    );
    new ResizeObserver(this.refresh).observe(this.scroller);
  }

  /** Shows other rows: with the next frame, or now where the caller is in a frame already. */
  set(rows: readonly T[], now = false): void {
    this.rows = rows;
    if (now) this.draw();
    else this.refresh();
  }

  /** Whether the last row is in sight. */
  atEnd(): boolean {
    const { scrollTop, clientHeight, scrollHeight } = this.scroller;
    return scrollTop + clientHeight >= scrollHeight - this.maker.height;
  }

  /** Keeps the newest row in sight until the person scrolls away. */
  follow(on: boolean): void {
    this.stick = on;
    this.refresh();
  }

  /** The row that an element of it stands for. */
  rowAt(target: EventTarget | null): T | undefined {
    const element = target instanceof Element ? target.closest<HTMLElement>('[data-row]') : null;
    return element ? this.shown.get(element) : undefined;
  }

  /** Brings a row into sight. */
  reveal(index: number): void {
    const top = index * this.maker.height;
    const { scrollTop, clientHeight } = this.scroller;
    if (top < scrollTop || top + this.maker.height > scrollTop + clientHeight)
      this.scroller.scrollTop = top - clientHeight / 2;
    this.refresh();
  }

  private draw(): void {
    const { height } = this.maker;
    const whole = `${this.rows.length * height}px`;
    if (this.canvas.style.height !== whole) this.canvas.style.height = whole;
    if (this.stick) this.scroller.scrollTop = this.scroller.scrollHeight;
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / height) - BEYOND);
    const inSight = Math.ceil(this.scroller.clientHeight / height) + 2 * BEYOND;
    const last = Math.min(this.rows.length, first + inSight);
    if (!this.isListbox) this.element.setAttribute('aria-rowcount', String(this.rows.length));
    for (let index = first; index < last; index += 1) this.place(index - first, index);
    for (let at = Math.max(0, last - first); at < this.pool.length; at += 1) this.pool[at].remove();
  }

  private place(at: number, index: number): void {
    const element = this.pool[at] ?? this.grow();
    if (!element.isConnected) this.canvas.append(element);
    if (element.dataset.row !== String(index)) {
      element.dataset.row = String(index);
      element.setAttribute(this.isListbox ? 'aria-posinset' : 'aria-rowindex', String(index + 1));
      element.style.transform = `translateY(${index * this.maker.height}px)`;
    }
    if (this.isListbox) element.setAttribute('aria-setsize', String(this.rows.length));
    this.shown.set(element, this.rows[index]);
    this.maker.fill(element, this.rows[index], index);
  }

  private get isListbox(): boolean {
    return this.maker.role === 'listbox';
  }

  private grow(): HTMLElement {
    const element = this.maker.make();
    element.classList.add('row');
    element.style.height = `${this.maker.height}px`;
    if (!element.hasAttribute('role'))
      element.setAttribute('role', this.isListbox ? 'option' : 'row');
    this.pool.push(element);
    return element;
  }
}

function headings(texts: readonly string[]): HTMLElement {
  return h(
    'div',
    { class: 'cells headings', role: 'row' },
    ...texts.map((text) => h('span', { role: 'columnheader' }, text)),
  );
}

/** A row of cells. */
export function cellRow(count: number): HTMLElement {
  return h(
    'div',
    { class: 'cells' },
    ...Array.from({ length: count }, () => h('span', { role: 'cell' })),
  );
}
