/** The widgets of a user's panel that a person acts on, and labels. */

import { numberOf, textOf, textsOf, type Json, type JsonObject } from '../json';
import { button, h, setText } from './dom';
import { short } from './format';

/** One widget on the page. */
export interface WidgetView {
  readonly element: HTMLElement;
  /** Shows the value that the panel's code knows. */
  show(value: Json): void;
  /** Points of a plot: `[time, value, value…]`. */
  add?(points: readonly Json[]): void;
  dispose?(): void;
}

/** Tells the panel's code what a person did; answers once that was taken. */
export type Act = (value: Json) => Promise<void>;

/** What stands beside a widget: its text, or its name in words. */
export function labelOf(spec: JsonObject): string {
  const name = textOf(spec, 'name').replaceAll('_', ' ');
  return textOf(spec, 'text') || name.charAt(0).toUpperCase() + name.slice(1);
}

/** A label at the left and something at the right of it. */
export function labelled(spec: JsonObject, control: HTMLElement): HTMLElement {
  return h(
    'div',
    { class: 'own-widget', title: textOf(spec, 'help') || undefined },
    h('span', { class: 'own-label ellipsis' }, labelOf(spec)),
    control,
  );
}

const MAKERS: Readonly<Record<string, (spec: JsonObject, act: Act) => WidgetView>> = {
  slider,
  number,
  checkbox,
  choice,
  textinput,
  button: press,
  label,
};

/** The view of a widget of this file, or null when it is of another kind. */
export function controlFor(spec: JsonObject, act: Act): WidgetView | null {
  return MAKERS[textOf(spec, 'kind')]?.(spec, act) ?? null;
}

/**
 * Sends the newest value as soon as the one before was taken: a slider that is dragged gives no
 * more values than the panel's code takes, and what comes back does not move it under the hand.
 */
class Newest {
  private waiting: { value: Json } | null = null;
  busy = false;

  constructor(private readonly act: Act) {}

  send(value: Json): void {
    this.waiting = { value };
    if (!this.busy) void this.run();
  }

  private async run(): Promise<void> {
    this.busy = true;
    while (this.waiting) {
      const { value } = this.waiting;
      this.waiting = null;
      await this.act(value);
    }
    this.busy = false;
  }
}

/** Whether somebody types into a field: what comes meanwhile must not take it away. */
class Typing {
  on = false;

  constructor(field: HTMLInputElement) {
    field.addEventListener('input', () => {
      this.on = true;
    });
    for (const end of ['change', 'blur'])
      field.addEventListener(end, () => {
        this.on = false;
      });
  }
}

function stepOf(spec: JsonObject, otherwise: number | 'any'): number | 'any' {
  return typeof spec.step === 'number' ? spec.step : otherwise;
}

function unit(spec: JsonObject): HTMLElement | null {
  const text = textOf(spec, 'unit');
  return text ? h('span', { class: 'dim' }, text) : null;
}

function slider(spec: JsonObject, act: Act): WidgetView {
  const [min, max] = [numberOf(spec, 'min'), numberOf(spec, 'max', 1)];
  const step = stepOf(spec, (max - min) / 1000);
  const name = labelOf(spec);
  const range = h('input', { type: 'range', min, max, step, 'aria-label': name });
  const field = h('input', {
    type: 'number',
    class: 'number',
    min,
    max,
    step: 'any',
    'aria-label': `${name} value`,
  });
  const newest = new Newest(act);
  const typing = new Typing(field);
  const put = (value: number) => {
    range.value = String(value);
    field.value = short(value);
  };
  range.addEventListener('input', () => {
    field.value = short(Number(range.value));
    newest.send(Number(range.value));
  });
  field.addEventListener('change', () => {
    range.value = field.value;
    newest.send(Number(field.value));
  });
  return {
    element: labelled(spec, h('span', { class: 'own-slider' }, range, field, unit(spec))),
    show: (value) => {
      if (!newest.busy && !typing.on && typeof value === 'number') put(value);
    },
  };
}

function number(spec: JsonObject, act: Act): WidgetView {
  const limit = (name: string) => (typeof spec[name] === 'number' ? spec[name] : undefined);
  const field = h('input', {
    type: 'number',
    class: 'number',
    min: limit('min'),
    max: limit('max'),
    step: stepOf(spec, 'any'),
    'aria-label': labelOf(spec),
  });
  const newest = new Newest(act);
  const typing = new Typing(field);
  field.addEventListener('change', () => {
    if (field.value !== '') newest.send(Number(field.value));
  });
  return {
    element: labelled(spec, h('span', { class: 'own-inline' }, field, unit(spec))),
    show: (value) => {
      if (!newest.busy && !typing.on && typeof value === 'number') field.value = short(value, 12);
    },
  };
}

function checkbox(spec: JsonObject, act: Act): WidgetView {
  const input = h('input', { type: 'checkbox', 'aria-label': labelOf(spec) });
  const newest = new Newest(act);
  input.addEventListener('change', () => newest.send(input.checked));
  return {
    element: labelled(spec, h('span', {}, input)),
    show: (value) => {
      if (!newest.busy) input.checked = value === true;
    },
  };
}

function choice(spec: JsonObject, act: Act): WidgetView {
  const options = textsOf(spec, 'options').map((option) => h('option', { value: option }, option));
  const element = h('select', { 'aria-label': labelOf(spec) }, ...options);
  const newest = new Newest(act);
  element.addEventListener('change', () => newest.send(element.value));
  return {
    element: labelled(spec, element),
    show: (value) => {
      if (!newest.busy) element.value = String(value ?? '');
    },
  };
}

function textinput(spec: JsonObject, act: Act): WidgetView {
  const input = h('input', {
    type: 'text',
    spellcheck: 'false',
    placeholder: textOf(spec, 'placeholder') || undefined,
    'aria-label': labelOf(spec),
  });
  const newest = new Newest(act);
  const typing = new Typing(input);
  input.addEventListener('change', () => newest.send(input.value));
  return {
    element: labelled(spec, input),
    show: (value) => {
      if (!newest.busy && !typing.on) input.value = String(value ?? '');
    },
  };
}

function press(spec: JsonObject, act: Act): WidgetView {
  const element = button(labelOf(spec), () => void act(null), {
    title: textOf(spec, 'help') || undefined,
  });
  return { element: h('div', { class: 'own-press' }, element), show: () => undefined };
}

function label(spec: JsonObject): WidgetView {
  const output = h('output', { class: 'own-value', 'aria-label': labelOf(spec) });
  const text = (value: Json) =>
    typeof value === 'number' ? short(value) : String(value ?? '') || '–';
  return {
    element: labelled(spec, h('span', { class: 'own-inline' }, output, unit(spec))),
    show: (value) => setText(output, text(value)),
  };
}
