/** One step of the assistant: its page, filled anew whenever the config package changed. */
import type { AssistantValue } from '../generated/messages';
import { h, notice, type Child } from '../widgets/dom';
import type { Preview } from './preview';
import type { Session } from './session';

/** What a step works with. */
export interface StepHost {
  readonly session: Session;
  readonly preview: Preview;
  /** Goes to another step. */
  go(name: string): void;
  /** Tells the person something that went well. */
  say(text: string): void;
}

/** A step; the list at the left has its name. */
export abstract class Step {
  abstract readonly name: string;
  abstract readonly about: string;
  readonly element = h('div', { class: 'scroll assistant-page', role: 'tabpanel' });
  /** Whether there is something to do before a robot is loaded. */
  readonly needsRobot: boolean = true;

  constructor(protected readonly host: StepHost) {}

  /** The step came to the front, or the config package changed while it is there. */
  refresh(): void {
    const { value } = this.host.session;
    this.element.setAttribute('aria-label', this.name);
    if (this.needsRobot && !value) {
      this.element.replaceChildren(notice('Load a robot first: step Start.'));
      return;
    }
    const focused = this.focusKey();
    this.element.replaceChildren(
      h('h2', { class: 'assistant-heading' }, this.name),
      h('p', { class: 'dim assistant-about' }, this.about),
      ...this.content(value),
    );
    if (focused) this.focusOn(focused);
  }

  /** The step went to the back. */
  left(): void {}

  protected abstract content(value: AssistantValue | null): (Child & Node)[];

  private focusKey(): string {
    const active = document.activeElement;
    return active && this.element.contains(active) ? (active.getAttribute('aria-label') ?? '') : '';
  }

  /** A page that was filled anew keeps the keyboard where it was. */
  private focusOn(label: string): void {
    const found = [...this.element.querySelectorAll<HTMLElement>('[aria-label]')].find(
      (element) => element.getAttribute('aria-label') === label,
    );
    found?.focus({ preventScroll: true });
  }
}

/** A labelled line of a form. */
export function field(label: string, ...controls: Child[]): HTMLDivElement {
  return h(
    'div',
    { class: 'assistant-field' },
    h('span', { class: 'assistant-label' }, label),
    ...controls,
  );
}

/** A text field; leaving it or Enter changes. */
export function textInput(
  label: string,
  value: string,
  changed: (text: string) => void,
): HTMLInputElement {
  const input = h('input', {
    type: 'text',
    'aria-label': label,
    value,
    spellcheck: 'false',
    autocomplete: 'off',
  });
  input.addEventListener('change', () => changed(input.value.trim()));
  return input;
}
