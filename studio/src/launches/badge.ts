/** The button of the top bar that counts what launches have found wrong. */

import type { Connection } from '../connection';
import { button, h, setText } from '../widgets/dom';
import { findingsStore, inWords } from './findings_store';

/** A button that is there while something is wrong; `open` shows the findings. */
export function findingsBadge(connection: Connection, open: () => void): HTMLElement {
  const store = findingsStore(connection);
  const text = h('span', {});
  const shown = button('', open, { icon: 'warning', class: 'badge' });
  shown.append(text);
  const said = h('span', { class: 'only-read', role: 'status' });
  store.watch(() => {
    const [errors, warnings] = [store.count('error'), store.count('warning')];
    const words = inWords(errors, warnings);
    shown.hidden = words === '';
    shown.dataset.level = errors ? 'error' : 'warn';
    shown.title = `What the launch has found: ${words}`;
    shown.setAttribute('aria-label', `Findings: ${words}`);
    setText(text, words);
    setText(said, words ? `The launch has found ${words}.` : '');
  });
  return h('span', { class: 'badge-place' }, shown, said);
}
