/** A form for a message: one line per field, made from the type's definition. */

import type { TypeField } from '../generated/messages';
import { isObject, type Json, type JsonObject } from '../json';
import { h } from './dom';

export interface FormOptions {
  /** Whether numbers may be expressions over `t` and `i`. */
  expressions?: boolean;
  changed: () => void;
}

interface Leaf {
  field: TypeField;
  path: string;
  input: HTMLInputElement;
}

const INTEGERS = /^(u?int(8|16|32|64)|byte|char|octet)$/;
const FLOATS = /^(float(32|64)?|double)$/;

/** The fields of a message to fill in. */
export class MessageForm {
  readonly element = h('div', { class: 'form', role: 'group', 'aria-label': 'Message' });
  private readonly leaves: Leaf[] = [];

  constructor(
    fields: readonly TypeField[],
    private readonly options: FormOptions,
  ) {
    this.element.append(...fields.map((field) => this.row(field, '', 0)));
  }

  /** The message as it stands. Expressions are left out. */
  message(): JsonObject {
    const message: JsonObject = {};
    for (const leaf of this.leaves) {
      if (this.expressionOf(leaf) === null) put(message, leaf.path, leafValue(leaf));
    }
    return message;
  }

  /** Numbers that are computed at every turn: `{"linear.x": "sin(t/2)"}`. */
  expressions(): Record<string, string> {
    const all: Record<string, string> = {};
    for (const leaf of this.leaves) {
      const expression = this.expressionOf(leaf);
      if (expression !== null) all[leaf.path] = expression;
    }
    return all;
  }

  /** What was typed, by path: only what differs from the default. */
  texts(): Record<string, string> {
    const differing = this.leaves.filter((leaf) => textIn(leaf.input) !== defaultText(leaf.field));
    return Object.fromEntries(differing.map((leaf) => [leaf.path, textIn(leaf.input)]));
  }

  /** Fills fields in, by path. */
  fill(texts: Json | undefined): void {
    if (!isObject(texts)) return;
    for (const leaf of this.leaves) {
      const text = texts[leaf.path];
      if (typeof text === 'string') setInput(leaf.input, text);
    }
  }

  private expressionOf(leaf: Leaf): string | null {
    if (!this.options.expressions || leaf.field.array !== null || !isNumber(leaf.field))
      return null;
    const text = leaf.input.value.trim();
    return text !== '' && Number.isNaN(numberFrom(text)) ? text : null;
  }

  private row(field: TypeField, parent: string, depth: number): HTMLElement {
    const path = parent ? `${parent}.${field.name}` : field.name;
    const label = h('span', { class: 'form-name', title: path }, field.name);
    const type = h('span', { class: 'form-type' }, typeText(field));
    if (field.fields && field.array === null) {
      const inside = h(
        'details',
        { class: 'form-branch', open: depth < 2 },
        h('summary', {}, label, type),
        h(
          'div',
          { class: 'form-inside' },
          ...field.fields.map((each) => this.row(each, path, depth + 1)),
        ),
      );
      return inside;
    }
    const input = this.input(field, path);
    this.leaves.push({ field, path, input });
    return h('label', { class: 'form-row' }, label, type, input);
  }

  private input(field: TypeField, path: string): HTMLInputElement {
    const tick = field.type === 'bool' || field.type === 'boolean';
    const input = h('input', {
      type: tick && field.array === null ? 'checkbox' : 'text',
      'aria-label': path,
      spellcheck: 'false',
      autocomplete: 'off',
      placeholder: field.array === null ? undefined : 'YAML list: [1, 2]',
      title:
        this.options.expressions && isNumber(field)
          ? 'A number, or an expression of t (seconds) and i (count): sin(t/2)'
          : undefined,
    });
    setInput(input, defaultText(field));
    input.addEventListener(tick ? 'change' : 'input', () => this.options.changed());
    return input;
  }
}

function isNumber(field: TypeField): boolean {
  return INTEGERS.test(field.type) || FLOATS.test(field.type);
}

function typeText(field: TypeField): string {
  if (field.array === null) return field.type;
  return typeof field.array === 'number' ? `${field.type}[${field.array}]` : `${field.type}[]`;
}

function defaultText(field: TypeField): string {
  if (field.array !== null)
    return typeof field.array === 'number' && isNumber(field)
      ? `[${Array(field.array).fill(0).join(', ')}]`
      : '[]';
  if (field.default !== undefined && field.default !== null && typeof field.default !== 'object')
    return String(field.default);
  if (field.type === 'bool' || field.type === 'boolean') return 'false';
  return isNumber(field) ? '0' : '';
}

function textIn(input: HTMLInputElement): string {
  return input.type === 'checkbox' ? String(input.checked) : input.value;
}

function setInput(input: HTMLInputElement, text: string): void {
  if (input.type === 'checkbox') input.checked = text === 'true' || text === 'True';
  else input.value = text;
}

function numberFrom(text: string): number {
  const named: Record<string, number> = {
    nan: 0,
    '.nan': 0,
    inf: 0,
    '.inf': 0,
    '-inf': 0,
    '-.inf': 0,
  };
  return text.toLowerCase() in named ? 0 : Number(text);
}

function leafValue(leaf: Leaf): Json {
  const text = textIn(leaf.input);
  if (leaf.input.type === 'checkbox') return leaf.input.checked;
  if (leaf.field.array === null && isNumber(leaf.field)) {
    const value = Number(text);
    return text.trim() === '' ? 0 : Number.isFinite(value) ? value : text;
  }
  return text;
}

function put(message: JsonObject, path: string, value: Json): void {
  const names = path.split('.');
  const last = names.pop() ?? '';
  let inside = message;
  for (const name of names) {
    const next = inside[name];
    if (isObject(next)) inside = next;
    else {
      const made: JsonObject = {};
      inside[name] = made;
      inside = made;
    }
  }
  if (value !== '' || !(last in inside)) inside[last] = value;
}
