/** Menus at a place of the page, and the menu of an entity. */
import { h } from '../widgets/dom';
import { openMenu, type MenuItem } from '../widgets/menu';

/** Open a menu where the pointer is. */
export function openMenuAt(x: number, y: number, label: string, items: readonly MenuItem[]): void {
  if (!items.length) return;
  const anchor = h('span', { class: 'menu-anchor', tabindex: -1 });
  anchor.style.left = `${x}px`;
  anchor.style.top = `${y}px`;
  document.body.append(anchor);
  openMenu(anchor, items, label);
  const watch = new MutationObserver(() => {
    if (anchor.getAttribute('aria-expanded') !== 'false') return;
    watch.disconnect();
    anchor.remove();
  });
  watch.observe(anchor, { attributes: true });
}
