/** Elements made from code: text is always text, never markup. */

type Listeners = { [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
type Attribute = string | number | boolean | undefined;
export interface Attributes {
  class?: string;
  on?: Listeners;
  [name: string]: Attribute | Listeners;
}
export type Child = Node | string | null | undefined;

const SVG = 'http://www.w3.org/2000/svg';

/** An HTML element with attributes, listeners and children. `false` leaves an attribute out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  setAttributes(element, attributes);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** An SVG element. */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  setAttributes(element, attributes);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function setAttributes(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (name === 'on') listen(element, value as Listeners);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
}

function listen(element: Element, listeners: Listeners): void {
  for (const [name, listener] of Object.entries(listeners)) {
    element.addEventListener(name, listener as EventListener);
  }
}

/** Sets an element's text only where it differs: most live values stay the same. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const ICONS = {
  play: 'M5 3.5v9l8-4.5z',
  pause: 'M4.5 3h2.5v10H4.5zM9 3h2.5v10H9z',
  step: 'M3 3.5v9l6.5-4.5zM10.5 3.5h2v9h-2z',
  reset: 'M8 3a5 5 0 1 1-4.6 3l1.4.6A3.5 3.5 0 1 0 8 4.5V7L4.5 3.8 8 .8z',
  close: 'M4 4l8 8M12 4l-8 8',
  plus: 'M8 3v10M3 8h10',
  minus: 'M3 8h10',
  menu: 'M3 4.5h10M3 8h10M3 11.5h10',
  down: 'M4 6.5l4 4 4-4',
  save: 'M8 2v7M5 6.5L8 9.5l3-3M3 13h10',
  fit: 'M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3',
  trash: 'M3.5 4.5h9M6 4.5V3h4v1.5M4.5 4.5l.6 8.5h5.8l.6-8.5',
  theme: 'M8 2.5a5.5 5.5 0 1 0 5.5 5.5A4.3 4.3 0 0 1 8 2.5z',
  record: 'M8 4a4 4 0 1 0 .01 0z',
  stop: 'M4 4h8v8H4z',
  refresh: 'M12.5 5A5 5 0 1 0 13 8.6M12.8 2.5V5.3H10',
  send: 'M2.5 8h10M8.5 4l4 4-4 4',
  layout: 'M2.5 3h11v10h-11zM6.5 3v10M6.5 8h7',
  panels: 'M2.5 2.5h4.5v4.5H2.5zM9 2.5h4.5v4.5H9zM2.5 9h4.5v4.5H2.5zM9 9h4.5v4.5H9z',
  clear: 'M4.5 4.5l7 7M8 2.5a5.5 5.5 0 1 0 .01 0z',
  random:
    'M2.5 5h2.5l5 6h3M2.5 11h2.5l1.6-2M8.9 6.6L10 5h3.5M12 3.5L13.5 5 12 6.5M12 9.5l1.5 1.5L12 12.5',
  centre: 'M8 2v4M8 10v4M2 8h4M10 8h4',
  home: 'M2.5 8L8 3l5.5 5M4 7v6h8V7M7 13V9.5h2V13',
  copy: 'M6 6h7v7.5H6zM3 10.5V2.5h7',
  warning: 'M8 2.5L14 13H2zM8 6.5v3.2M8 11.4v.3',
  help: 'M6 6a2 2 0 1 1 2.8 1.9c-.6.3-.8.6-.8 1.3M8 11.6v.4',
} as const;
const FILLED = new Set(['play', 'pause', 'step', 'reset', 'record', 'stop', 'theme']);
export type IconName = keyof typeof ICONS;

/** A 16-pixel picture in the colour of the text. */
export function icon(name: IconName): SVGSVGElement {
  const filled = FILLED.has(name);
  return s(
    'svg',
    { class: 'icon', viewBox: '0 0 16 16', width: 16, height: 16, 'aria-hidden': 'true' },
    s('path', {
      d: ICONS[name],
      fill: filled ? 'currentColor' : 'none',
      stroke: filled ? 'none' : 'currentColor',
      'stroke-width': 1.5,
      'stroke-linecap': 'round',
      'stroke-linejoin': 'round',
    }),
  );
}

export interface ButtonOptions {
  icon?: IconName;
  title?: string;
  class?: string;
  pressed?: boolean;
  text?: string;
}

/** A button; one that shows only a picture is named by its title. */
export function button(
  text: string,
  run: (event: MouseEvent) => void,
  options: ButtonOptions = {},
): HTMLButtonElement {
  const element = h('button', {
    type: 'button',
    class: `button ${options.class ?? ''}`.trim(),
    title: options.title,
    'aria-label': text ? undefined : options.title,
    on: { click: run },
  });
  if (options.icon) element.append(icon(options.icon));
  if (text) element.append(h('span', {}, text));
  if (options.pressed !== undefined) element.setAttribute('aria-pressed', String(options.pressed));
  return element;
}

/** A button that stays pressed; `changed` hears of the new state. */
export function toggle(
  text: string,
  on: boolean,
  changed: (on: boolean) => void,
  options: ButtonOptions = {},
): HTMLButtonElement {
  const element = button(
    text,
    () => {
      const now = element.getAttribute('aria-pressed') !== 'true';
      element.setAttribute('aria-pressed', String(now));
      changed(now);
    },
    { ...options, pressed: on },
  );
  return element;
}

/** A labelled checkbox. */
export function checkbox(
  text: string,
  on: boolean,
  changed: (on: boolean) => void,
  title?: string,
): HTMLLabelElement {
  const input = h('input', { type: 'checkbox', on: { change: () => changed(input.checked) } });
  input.checked = on;
  return h('label', { class: 'check', title }, input, h('span', {}, text));
}

/** A choice out of a list; options are values or pairs of value and text. */
export function select(
  label: string,
  options: readonly (string | readonly [string, string])[],
  value: string,
  changed: (value: string) => void,
): HTMLSelectElement {
  const element = h('select', {
    'aria-label': label,
    title: label,
    on: { change: () => changed(element.value) },
  });
  fillSelect(element, options, value);
  return element;
}

/** Replaces the options of a choice. */
export function fillSelect(
  element: HTMLSelectElement,
  options: readonly (string | readonly [string, string])[],
  value: string,
): void {
  element.replaceChildren(
    ...options.map((option) => {
      const [key, text] = typeof option === 'string' ? [option, option] : option;
      return h('option', { value: key }, text);
    }),
  );
  element.value = value;
}

/** A row of controls above a panel's contents. */
export function toolbar(label: string, ...children: Child[]): HTMLDivElement {
  return h('div', { class: 'toolbar', role: 'toolbar', 'aria-label': label }, ...children);
}

/** Takes the rest of a toolbar's width. */
export function spacer(): HTMLSpanElement {
  return h('span', { class: 'spacer' });
}

/** What a panel says when it has nothing to show. */
export function notice(text: string): HTMLDivElement {
  return h('div', { class: 'notice' }, text);
}

/**
 * Runs work at most once per animation frame, however often it is asked for, and not within
 * `least_ms` of the last time.
 */
export function perFrame(work: () => void, least_ms = 0): () => void {
  let asked = false;
  let last = -Infinity;
  const turn = (now: number) => {
    if (now - last < least_ms) {
      setTimeout(() => requestAnimationFrame(turn), least_ms - (now - last));
      return;
    }
    asked = false;
    last = now;
    work();
  };
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(turn);
  };
}
