/** The control that fits a parameter: slider with a number, tick box, choice, text. */

import type { Json } from '../json';
import { fillSelect, h } from './dom';
import { short } from './format';
import { valueFromText } from './value_text';

/** A parameter as its control needs it. */
export interface ParameterSpec {
  name: string;
  type: string;
  value: Json;
  min?: number;
  max?: number;
  step?: number;
  options?: readonly { name: string; value: Json; about: string }[];
  about: string;
  readOnly: boolean;
}

/** A labelled control; `show` writes the value of now unless the person is at it. */
export interface ValueControl {
  element: HTMLElement;
  show(value: Json): void;
}

const WIDEST_SLIDER = 1e6;

/** Makes the control of a parameter; `set` is told what the person chose. */
export function valueControl(spec: ParameterSpec, set: (value: Json) => void): ValueControl {
  const [control, show] = inputFor(spec, set);
  const element = h(
    'div',
    { class: 'param-row', title: spec.about || undefined },
    h('span', { class: 'param-name ellipsis' }, spec.name),
    control,
  );
  if (spec.readOnly)
    for (const input of element.querySelectorAll<HTMLInputElement>('input, select'))
      input.disabled = true;
  show(spec.value);
  return { element, show };
}

type Made = [HTMLElement, (value: Json) => void];

function inputFor(spec: ParameterSpec, set: (value: Json) => void): Made {
  if (spec.options && spec.options.length > 0) return choice(spec, set);
  if (/^bool/.test(spec.type)) return tick(spec, set);
  if (/^(int|integer|double|float)/.test(spec.type) && !spec.type.includes('array'))
    return numeric(spec, set);
  return text(spec, set);
}

function choice(spec: ParameterSpec, set: (value: Json) => void): Made {
  const options = spec.options ?? [];
  const element = h('select', { 'aria-label': spec.name });
  fillSelect(
    element,
    options.map(
      (option) =>
        [JSON.stringify(option.value), `${option.name} (${String(option.value)})`] as const,
    ),
    '',
  );
  element.addEventListener('change', () => set(JSON.parse(element.value) as Json));
  return [
    element,
    (value) => {
      if (document.activeElement !== element) element.value = JSON.stringify(value);
    },
  ];
}

function tick(spec: ParameterSpec, set: (value: Json) => void): Made {
  const input = h('input', { type: 'checkbox', 'aria-label': spec.name });
  input.addEventListener('change', () => set(input.checked));
  return [
    h('span', {}, input),
    (value) => {
      input.checked = value === true;
    },
  ];
}

function numeric(spec: ParameterSpec, set: (value: Json) => void): Made {
  const whole = spec.type.startsWith('int');
  const number = h('input', {
    type: 'number',
    step: whole ? 1 : 'any',
    class: 'number',
    'aria-label': spec.name,
  });
  number.addEventListener('change', () => set(Number(number.value)));
  const { min, max } = spec;
  const finite =
    min !== undefined &&
    max !== undefined &&
    Math.abs(min) < WIDEST_SLIDER &&
    Math.abs(max) < WIDEST_SLIDER &&
    max > min;
  if (!finite)
    return [h('span', { class: 'param-number' }, number), (value) => showIn(number, value)];
  const slider = h('input', {
    type: 'range',
    min,
    max,
    step: whole ? 1 : spec.step || (max - min) / 1000,
    'aria-label': `${spec.name} slider`,
  });
  slider.addEventListener('input', () => {
    number.value = slider.value;
    set(Number(slider.value));
  });
  const box = h(
    'span',
    { class: 'param-number' },
    h('span', { class: 'limit' }, short(min, 4)),
    slider,
    h('span', { class: 'limit' }, short(max, 4)),
    number,
  );
  return [
    box,
    (value) => {
      showIn(number, value);
      showIn(slider, value);
    },
  ];
}

function text(spec: ParameterSpec, set: (value: Json) => void): Made {
  const input = h('input', { type: 'text', 'aria-label': spec.name, spellcheck: 'false' });
  const isText = spec.type === 'str' || spec.type === 'string';
  input.addEventListener('change', () => set(isText ? input.value : valueFromText(input.value)));
  return [
    input,
    (value) => {
      if (document.activeElement !== input)
        input.value = typeof value === 'string' ? value : JSON.stringify(value);
    },
  ];
}

function showIn(input: HTMLInputElement, value: Json): void {
  if (document.activeElement !== input && typeof value === 'number')
    input.value = String(Number(value.toPrecision(12)));
}
