/** One property of a display as a row: its name and how it is edited. */
import type { Json } from '../json';
import { h } from '../widgets/dom';
import { nameInput } from '../widgets/name_input';
import type { PropertySpec } from './properties';

/** Names for topics and frames, asked for when a field gets the focus. */
export interface Known {
  topics(types: readonly string[]): string[];
  frames(): string[];
}

/** The control for a property; `changed` hears of new values. */
export function editor(
  spec: PropertySpec,
  value: Json,
  known: Known,
  changed: (value: Json) => void,
): HTMLElement {
  const label = spec.path.split('/').pop() ?? spec.path;
  switch (spec.kind) {
    case 'bool':
      return box(label, value, changed);
    case 'number':
      return numberField(spec, label, value, changed);
    case 'colour':
      return colourField(label, String(value), changed);
    case 'choice':
      return choiceField(spec, label, String(value), changed);
    case 'topic':
      return nameInput({
        label,
        placeholder: 'topic',
        value: String(value ?? ''),
        names: () => known.topics(spec.types ?? []),
        chosen: changed,
      });
    case 'frame':
      return nameInput({
        label,
        value: String(value ?? ''),
        names: () => known.frames(),
        chosen: changed,
      });
    default:
      return textField(label, String(value ?? ''), changed);
  }
}

function box(label: string, value: Json, changed: (value: Json) => void): HTMLElement {
  const input = h('input', {
    type: 'checkbox',
    'aria-label': label,
    on: { change: () => changed(input.checked) },
  });
  input.checked = value === true || value === 'true';
  return input;
}

function numberField(
  spec: PropertySpec,
  label: string,
  value: Json,
  changed: (value: Json) => void,
): HTMLElement {
  const input = h('input', {
    type: 'number',
    step: 'any',
    min: spec.min,
    max: spec.max,
    value: String(value),
    'aria-label': label,
    on: {
      change: () => input.checkValidity() && input.value !== '' && changed(Number(input.value)),
    },
  });
  return input;
}

/** RViz's "255; 85; 0" beside the browser's own colour picker. */
function colourField(label: string, value: string, changed: (value: Json) => void): HTMLElement {
  const numbers = (text: string): number[] =>
    text
      .split(/[;,\s]+/)
      .filter(Boolean)
      .map(Number);
  const hex = (text: string): string =>
    `#${numbers(text)
      .slice(0, 3)
      .map((n) =>
        Math.max(0, Math.min(255, Math.round(n) || 0))
          .toString(16)
          .padStart(2, '0'),
      )
      .join('')}`;
  const words = h('input', { type: 'text', value, 'aria-label': label, spellcheck: 'false' });
  const picker = h('input', { type: 'color', value: hex(value), 'aria-label': `${label}: picker` });
  picker.addEventListener('input', () => {
    words.value = [1, 3, 5].map((at) => parseInt(picker.value.slice(at, at + 2), 16)).join('; ');
    changed(words.value);
  });
  words.addEventListener('change', () => {
    const good = numbers(words.value).length === 3 && numbers(words.value).every(Number.isFinite);
    words.classList.toggle('bad', !good);
    if (!good) return;
    picker.value = hex(words.value);
    changed(words.value);
  });
  return h('span', { class: 'colour-field' }, picker, words);
}

function choiceField(
  spec: PropertySpec,
  label: string,
  value: string,
  changed: (value: Json) => void,
): HTMLElement {
  const input = h(
    'select',
    { 'aria-label': label, on: { change: () => changed(input.value) } },
    ...(spec.options ?? []).map((option) => h('option', { value: option }, option || 'automatic')),
  );
  input.value = value;
  return input;
}

function textField(label: string, value: string, changed: (value: Json) => void): HTMLElement {
  const input = h('input', {
    type: 'text',
    value,
    'aria-label': label,
    spellcheck: 'false',
    on: { change: () => changed(input.value.trim()) },
  });
  return input;
}
