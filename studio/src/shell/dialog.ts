/** Dialogs: a question with one answer, and the list of keyboard shortcuts. */

import { button, h } from '../widgets/dom';

/** Asks for one line of text; null when the person thinks better of it. */
export function askText(title: string, label: string, value = ''): Promise<string | null> {
  return new Promise((resolve) => {
    const input = h('input', { type: 'text', value, required: true });
    const form = h(
      'form',
      { method: 'dialog' },
      h('h2', {}, title),
      h('label', { class: 'stacked' }, label, input),
      h(
        'div',
        { class: 'dialog-buttons' },
        button('Cancel', () => dialog.close('')),
        h('button', { type: 'submit', class: 'button primary', value: 'ok' }, 'OK'),
      ),
    );
    const dialog = h('dialog', { class: 'dialog', 'aria-label': title }, form);
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'ok' ? input.value.trim() : null);
    });
    document.body.append(dialog);
    dialog.showModal();
    input.select();
  });
}

/** Asks for a file of the person's machine; null when none is chosen. */
export function askFile(accept: string): Promise<File | null> {
  return new Promise((resolve) => {
    const input = h('input', { type: 'file', accept, hidden: true });
    input.addEventListener('change', () => {
      resolve(input.files?.[0] ?? null);
      input.remove();
    });
    input.addEventListener('cancel', () => {
      resolve(null);
      input.remove();
    });
    document.body.append(input);
    input.click();
  });
}

/** Asks whether something that cannot be undone shall be done. */
export function confirmDanger(title: string, text: string, verb: string): Promise<boolean> {
  return new Promise((resolve) => {
    const dialog = h(
      'dialog',
      { class: 'dialog', 'aria-label': title },
      h('h2', {}, title),
      h('p', {}, text),
      h(
        'div',
        { class: 'dialog-buttons' },
        button('Cancel', () => dialog.close('')),
        button(verb, () => dialog.close('yes'), { class: 'danger' }),
      ),
    );
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'yes');
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}

/** Opens a dialog to be read, with a button that closes it; what had the focus has it then again. */
export function openDialog(title: string, ...content: readonly HTMLElement[]): HTMLDialogElement {
  const before = document.activeElement;
  const dialog = h(
    'dialog',
    { class: 'dialog', 'aria-label': title },
    h('h2', {}, title),
    ...content,
    h(
      'div',
      { class: 'dialog-buttons' },
      button('Close', () => dialog.close()),
    ),
  );
  dialog.addEventListener('close', () => {
    dialog.remove();
    if (before instanceof HTMLElement) before.focus();
  });
  document.body.append(dialog);
  dialog.showModal();
  dialog.querySelector<HTMLElement>('.dialog-buttons .button')?.focus();
  return dialog;
}

/** Keys with what they do. */
export function shortcutList(rows: readonly (readonly [string, string])[]): HTMLElement {
  return h(
    'dl',
    { class: 'shortcuts' },
    ...rows.flatMap(([keys, text]) => [h('dt', {}, h('kbd', {}, keys)), h('dd', {}, text)]),
  );
}
