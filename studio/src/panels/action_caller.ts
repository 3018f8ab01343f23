/** Action caller: a goal from a form, its feedback, its result, cancelling. */

import type { Channel } from '../channel';
import type { GoalState, TypeField, TypeValue } from '../generated/messages';
import { isObject, textOf, type Json, type JsonObject } from '../json';
import { button, h, notice, setText, spacer, toolbar } from '../widgets/dom';
import { MessageForm } from '../widgets/message_form';
import { asYaml } from '../widgets/message_rows';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';

const OVER = /succeeded|aborted|rejected|cancel(l)?ed|preempted|recalled|lost/i;

/** Sends goals to action servers. */
export class ActionCaller extends BasePanel {
  readonly title = 'Action Caller';
  private action = '';
  private type = '';
  private form: MessageForm | null = null;
  private texts: Json = {};
  private channel: Channel | null = null;
  private readonly input: HTMLInputElement;
  private readonly typeText = h('span', { class: 'dim ellipsis' });
  private readonly goal = h(
    'div',
    { class: 'half scroll', role: 'region', 'aria-label': 'Goal' },
    notice('Choose an action.'),
  );
  private readonly status = h('strong', { class: 'action-state', role: 'status' });
  private readonly feedback = h('pre', { class: 'mono', role: 'group', 'aria-label': 'Feedback' });
  private readonly result = h('pre', { class: 'mono', role: 'group', 'aria-label': 'Result' });
  private readonly sendButton = button('Send goal', () => this.send(), {
    icon: 'send',
    class: 'primary',
  });
  private readonly cancelButton = button('Cancel', () => this.cancel(), {
    icon: 'stop',
    title: 'Cancel the goal',
  });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.input = nameInput({
      label: 'Action',
      names: () => this.host.graph.value.actions.map((each) => each.name),
      chosen: (name) => void this.choose(name),
    });
    this.sendButton.disabled = true;
    this.cancelButton.disabled = true;
    this.element.append(
      toolbar(
        'Action caller',
        h('span', {}, this.input),
        this.typeText,
        spacer(),
        this.sendButton,
        this.cancelButton,
      ),
      h(
        'div',
        { class: 'halves' },
        this.goal,
        h(
          'div',
          { class: 'half scroll' },
          this.status,
          h('h3', {}, 'Feedback'),
          this.feedback,
          h('h3', {}, 'Result'),
          this.result,
        ),
      ),
    );
  }

  override open(params: JsonObject): void {
    this.texts = params.texts ?? {};
    const action = textOf(params, 'action');
    if (action) void this.choose(action);
  }

  override state(): JsonObject {
    return { action: this.action, texts: this.form?.texts() ?? this.texts };
  }

  private async choose(action: string): Promise<void> {
    if (action !== this.action && this.action) this.texts = {};
    this.action = action;
    this.input.value = action;
    this.form = null;
    this.host.touched();
    this.type = this.host.graph.value.actions.find((each) => each.name === action)?.type ?? '';
    setText(this.typeText, this.type);
    this.sendButton.disabled = true;
    if (!this.type) {
      this.goal.replaceChildren(
        notice(action ? `Nobody serves the action ${action} now.` : 'Choose an action.'),
      );
      return;
    }
    const type = await this.ask('type.get', { type: this.type, kind: 'action' });
    if (action !== this.action) return;
    this.form = new MessageForm(goalFields(type), { changed: () => this.host.touched() });
    this.form.fill(this.texts);
    this.goal.replaceChildren(this.form.element);
    this.sendButton.disabled = false;
  }

  private send(): void {
    if (!this.form) return;
    this.endStream(this.channel);
    for (const output of [this.feedback, this.result]) setText(output, '');
    setText(this.status, 'sent');
    this.cancelButton.disabled = false;
    this.channel = this.stream(
      'action',
      { action: this.action, type: this.type, goal: this.form.message() },
      {
        onData: (value) => this.take(value as unknown as GoalState),
        onFailed: (problem) => {
          this.host.fail(problem);
          this.finish('failed');
        },
        onEnded: (problem) => {
          if (problem) this.host.fail(problem);
          this.cancelButton.disabled = true;
        },
      },
    );
  }

  private take({ state, feedback, result }: GoalState): void {
    setText(this.status, state);
    if (isObject(feedback)) setText(this.feedback, asYaml(feedback));
    if (isObject(result)) setText(this.result, asYaml(result) || '(the result has no fields)');
    if (OVER.test(state)) this.finish(state);
  }

  private finish(state: string): void {
    setText(this.status, state);
    this.cancelButton.disabled = true;
    this.endStream(this.channel);
    this.channel = null;
  }

  private cancel(): void {
    this.finish('cancelled');
  }
}

function goalFields(type: Json): TypeField[] {
  return (
    (type as unknown as TypeValue | null)?.fields.find((field) => field.name === 'goal')?.fields ??
    []
  );
}
