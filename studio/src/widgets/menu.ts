/** Menus that drop down from a button: arrow keys, first letters, Escape. */

import { h } from './dom';

export interface MenuItem {
  text: string;
  run?: () => void;
  /** A heading instead of something to choose. */
  heading?: boolean;
  /** Shown at the right: a shortcut or a command's name. */
  note?: string;
  title?: string;
  checked?: boolean;
  /** Greyed, and still to be chosen. */
  faded?: boolean;
}

const COLUMN_PX = 270;

let shut: (() => void) | null = null;

/** Opens a menu below an element; the one that is open closes. */
export function openMenu(
  anchor: HTMLElement,
  items: readonly MenuItem[],
  label: string,
  columns = 1,
): void {
  const again = anchor.getAttribute('aria-expanded') === 'true';
  shut?.();
  if (again) return;
  const menu = h('div', { class: 'menu', role: 'menu', 'aria-label': label });
  menu.style.columnCount = String(Math.min(columns, Math.floor(innerWidth / COLUMN_PX) || 1));
  for (const section of sections(items)) {
    menu.append(
      h('div', { class: 'menu-section', role: 'group' }, ...section.map((item) => entry(item))),
    );
  }
  document.body.append(menu);
  place(menu, anchor);
  anchor.setAttribute('aria-expanded', 'true');
  listen(menu, anchor);
  (menu.querySelector('[role^=menuitem]') as HTMLElement | null)?.focus();
}

function sections(items: readonly MenuItem[]): MenuItem[][] {
  const all: MenuItem[][] = [[]];
  for (const item of items) {
    if (item.heading) all.push([]);
    all[all.length - 1].push(item);
  }
  return all.filter((section) => section.length > 0);
}

function entry(item: MenuItem): HTMLElement {
  if (item.heading) return h('div', { class: 'menu-heading' }, item.text);
  const role = item.checked === undefined ? 'menuitem' : 'menuitemcheckbox';
  return h(
    'button',
    {
      type: 'button',
      class: item.faded ? 'menu-item faded' : 'menu-item',
      role,
      title: item.title,
      tabindex: -1,
      'aria-checked': item.checked === undefined ? undefined : String(item.checked),
      on: {
        click: () => {
          shut?.();
          item.run?.();
        },
      },
    },
    h('span', {}, item.text),
    item.note ? h('span', { class: 'menu-note' }, item.note) : null,
  );
}

function place(menu: HTMLElement, anchor: HTMLElement): void {
  const box = anchor.getBoundingClientRect();
  menu.style.top = `${box.bottom + 4}px`;
  const left = Math.min(box.left, innerWidth - menu.offsetWidth - 8);
  menu.style.left = `${Math.max(8, left)}px`;
  menu.style.maxHeight = `${innerHeight - box.bottom - 16}px`;
}

function listen(menu: HTMLElement, anchor: HTMLElement): void {
  const outside = (event: Event) => {
    const target = event.target as Node;
    if (!menu.contains(target) && !anchor.contains(target)) shut?.();
  };
  const keys = (event: KeyboardEvent) => onKey(event, menu, anchor);
  document.addEventListener('pointerdown', outside, true);
  menu.addEventListener('keydown', keys);
  shut = () => {
    document.removeEventListener('pointerdown', outside, true);
    anchor.setAttribute('aria-expanded', 'false');
    menu.remove();
    shut = null;
  };
}

function onKey(event: KeyboardEvent, menu: HTMLElement, anchor: HTMLElement): void {
  const items = [...menu.querySelectorAll<HTMLElement>('[role^=menuitem]')];
  const at = items.indexOf(document.activeElement as HTMLElement);
  event.stopPropagation();
  if (event.key === 'Escape' || event.key === 'Tab') {
    shut?.();
    anchor.focus();
  } else if (event.key === 'ArrowDown') items[(at + 1) % items.length]?.focus();
  else if (event.key === 'ArrowUp') items[(at - 1 + items.length) % items.length]?.focus();
  else if (event.key === 'Home') items[0]?.focus();
  else if (event.key === 'End') items[items.length - 1]?.focus();
  else if (event.key.length === 1) byLetter(items, at, event.key);
  else return;
  if (event.key !== 'Tab' && event.key !== ' ') event.preventDefault();
}

function byLetter(items: HTMLElement[], at: number, letter: string): void {
  const turned = [...items.slice(at + 1), ...items.slice(0, at + 1)];
  turned.find((item) => item.textContent?.toLowerCase().startsWith(letter.toLowerCase()))?.focus();
}
