/** Short messages at the corner: what went wrong, what to do about it, what there is instead. */

import { asCallError } from '../errors';
import { button, h } from '../widgets/dom';

const ERROR_MS = 12_000;
const INFO_MS = 3_500;
const MOST = 5;

/** Shows messages in an element with a live region. */
export class Toasts {
  constructor(private readonly root: HTMLElement) {}

  /** An error: message, hint and known names. The same message is not repeated while it shows. */
  fail(problem: unknown, where = ''): void {
    const error = asCallError(problem);
    const text = where ? `${where}: ${error.message}` : error.message;
    const parts: HTMLElement[] = [h('div', { class: 'toast-text' }, text)];
    if (error.hint) parts.push(h('div', { class: 'toast-hint' }, error.hint));
    if (error.known.length > 0) {
      const names = error.known.slice(0, 12).join(', ');
      const more = error.known.length > 12 ? ` and ${error.known.length - 12} more` : '';
      parts.push(h('div', { class: 'toast-known' }, `There is: ${names}${more}`));
    }
    this.add('error', parts, ERROR_MS);
  }

  /** Something that went well. */
  tell(text: string): void {
    this.add('info', [h('div', { class: 'toast-text' }, text)], INFO_MS);
  }

  private add(level: string, parts: HTMLElement[], lasts_ms: number): void {
    const key = parts.map((part) => part.textContent).join('\n');
    for (const old of this.root.querySelectorAll<HTMLElement>('.toast'))
      if (old.dataset.key === key) old.remove();
    const toast = h(
      'div',
      {
        class: `toast toast-${level}`,
        role: level === 'error' ? 'alert' : 'status',
        'data-key': key,
      },
      h('div', { class: 'toast-body' }, ...parts),
      button('', () => toast.remove(), { icon: 'close', title: 'Dismiss', class: 'ghost' }),
    );
    this.root.append(toast);
    while (this.root.childElementCount > MOST) this.root.firstElementChild?.remove();
    setTimeout(() => toast.remove(), lasts_ms);
  }
}
