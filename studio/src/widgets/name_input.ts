/** Text fields that know names: topics of some types, services, types. */

import { h } from './dom';

export interface NameInputOptions {
  label: string;
  placeholder?: string;
  value?: string;
  /** The names to choose from, asked for whenever the field gets the focus. */
  names: () => readonly string[] | Promise<readonly string[]>;
  chosen: (name: string) => void;
}

let count = 0;

/** A field with the known names as suggestions; Enter or leaving the field chooses. */
export function nameInput(options: NameInputOptions): HTMLInputElement {
  const list = h('datalist', { id: `names-${++count}` });
  const input = h('input', {
    type: 'text',
    class: 'name',
    list: list.id,
    'aria-label': options.label,
    placeholder: options.placeholder ?? options.label,
    spellcheck: 'false',
    autocomplete: 'off',
    value: options.value ?? '',
  });
  const offer = (names: readonly string[]) =>
    list.replaceChildren(...names.map((name) => h('option', { value: name })));
  input.addEventListener('focus', () => void Promise.resolve(options.names()).then(offer));
  input.addEventListener('change', () => options.chosen(input.value.trim()));
  input.append(list);
  queueMicrotask(() => input.after(list));
  return input;
}
