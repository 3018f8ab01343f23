/** Service Caller: a form for the request, the response as a tree. */

import { inOneLine } from '../errors';
import type { TypeField } from '../generated/messages';
import { isObject, textOf, textsOf, type Json, type JsonObject } from '../json';
import { button, h, notice, setText, spacer, toolbar } from '../widgets/dom';
import { MessageForm } from '../widgets/message_form';
import { asYaml } from '../widgets/message_rows';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';

const TIMEOUT_S = 10;

/** rqt_service_caller. */
export class ServiceCaller extends BasePanel {
  readonly title = 'Service Caller';
  private service = '';
  private form: MessageForm | null = null;
  private texts: Json = {};
  private readonly input: HTMLInputElement;
  private readonly type = h('span', { class: 'dim ellipsis' });
  private readonly request = h(
    'div',
    { class: 'half scroll', role: 'region', 'aria-label': 'Request' },
    notice('Choose a service.'),
  );
  private readonly response = h('pre', {
    class: 'half scroll mono',
    role: 'region',
    'aria-label': 'Response',
    'aria-live': 'polite',
    tabindex: 0,
  });
  private readonly callButton = button('Call', () => void this.callNow(), {
    icon: 'send',
    title: 'Call the service',
    class: 'primary',
  });
  private readonly took = h('span', { class: 'dim' });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.input = nameInput({
      label: 'Service',
      names: () => this.host.graph.value.services.map((each) => each.name),
      chosen: (name) => void this.choose(name),
    });
    this.callButton.disabled = true;
    this.element.append(
      toolbar(
        'Service caller',
        h('span', {}, this.input),
        this.type,
        spacer(),
        this.took,
        this.callButton,
      ),
      h('div', { class: 'halves' }, this.request, this.response),
    );
  }

  override open(params: JsonObject): void {
    const service = textOf(params, 'service') || textsOf(params, 'args')[0];
    this.texts = params.texts ?? {};
    if (service) void this.choose(service);
  }

  override state(): JsonObject {
    return { service: this.service, texts: this.form?.texts() ?? this.texts };
  }

  private async choose(service: string): Promise<void> {
    if (service !== this.service && this.service) this.texts = {};
    this.service = service;
    this.input.value = service;
    this.form = null;
    this.callButton.disabled = true;
    this.host.touched();
    const known = this.host.graph.value.services.find((each) => each.name === service);
    setText(this.type, known?.type ?? '');
    if (!known?.type) {
      this.request.replaceChildren(
        notice(service ? `Nobody serves ${service} now.` : 'Choose a service.'),
      );
      return;
    }
    const type = await this.ask('type.get', { type: known.type, kind: 'srv' });
    if (service !== this.service) return;
    this.form = new MessageForm(requestFields(type), { changed: () => this.host.touched() });
    this.form.fill(this.texts);
    this.request.replaceChildren(
      requestFields(type).length > 0 ? this.form.element : notice('The request has no fields.'),
    );
    this.callButton.disabled = false;
  }

  private async callNow(): Promise<void> {
    if (!this.form) return;
    this.callButton.disabled = true;
    const begin = performance.now();
    try {
      const value = await this.connection.call('service.call', {
        service: this.service,
        request: this.form.message(),
        timeout_s: TIMEOUT_S,
      });
      const response =
        isObject(value) && isObject(value.response) && Object.keys(value).length === 1
          ? value.response
          : value;
      this.response.classList.remove('bad');
      setText(this.response, asYaml(response) || '(the response has no fields)');
    } catch (problem) {
      this.response.classList.add('bad');
      setText(this.response, inOneLine(problem));
    }
    setText(this.took, `${(performance.now() - begin).toFixed(0)} ms`);
    this.callButton.disabled = false;
  }
}

function requestFields(type: Json): TypeField[] {
  if (!isObject(type) || !Array.isArray(type.fields)) return [];
  const request = (type.fields as unknown as TypeField[]).find((field) => field.name === 'request');
  return request?.fields ?? [];
}
