/** Message Publisher and Easy Message Publisher: messages from forms, at a rate, with expressions. */

import { isObject, numberOf, textOf, type Json, type JsonObject } from '../json';
import { button, h, notice, spacer, toolbar } from '../widgets/dom';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';
import { PublisherCard, type PublisherState } from './publisher_card';

/** Any number of publishers, one below the other. */
export class Publisher extends BasePanel {
  private readonly cards: PublisherCard[] = [];
  private readonly list = h('div', { class: 'scroll cards' });
  private readonly topic: HTMLInputElement;
  private readonly type: HTMLInputElement;
  private readonly empty = notice('Name a topic and its type to publish on it.');

  constructor(
    readonly title: string,
    private readonly easy: boolean,
    ...args: ConstructorParameters<typeof BasePanel>
  ) {
    super(...args);
    this.topic = nameInput({
      label: 'Topic',
      value: '',
      names: () =>
        this.host.graph.value.topics.filter((each) => !each.hidden).map((each) => each.name),
      chosen: (name) => {
        this.type.value = this.host.graph.typeOf(name) ?? this.type.value;
      },
    });
    this.type = nameInput({
      label: 'Type',
      names: () => this.typeNames(),
      chosen: () => undefined,
    });
    const rate = h('input', {
      type: 'number',
      min: 0,
      step: 'any',
      value: 1,
      'aria-label': 'Rate in Hz',
      title: 'Rate in Hz',
      class: 'small',
    });
    const add = () =>
      this.add({
        topic: this.topic.value.trim(),
        type: this.type.value.trim(),
        rate_hz: Number(rate.value),
      });
    for (const input of [this.topic, this.type])
      input.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') add();
      });
    this.element.append(
      toolbar(
        title,
        h('span', {}, this.topic),
        h('span', {}, this.type),
        rate,
        h('span', { class: 'dim' }, 'Hz'),
        button('Add', add, { icon: 'plus', title: 'Add a publisher' }),
        spacer(),
      ),
      this.list,
    );
    this.list.append(this.empty);
  }

  override open(params: JsonObject): void {
    const saved = params.publishers;
    if (Array.isArray(saved))
      for (const each of saved) if (isObject(each)) this.add(readState(each));
    const topic = textOf(params, 'topic');
    if (topic)
      this.add({
        topic,
        type: textOf(params, 'type') || (this.host.graph.typeOf(topic) ?? ''),
        rate_hz: numberOf(params, 'rate_hz', 1),
      });
  }

  override state(): JsonObject {
    return { publishers: this.cards.map((card) => card.state() as unknown as Json) };
  }

  override dispose(): void {
    for (const card of this.cards) card.remove();
    super.dispose();
  }

  private add(state: PublisherState): void {
    if (!state.topic || !state.type) {
      this.host.fail(
        new Error(
          state.topic
            ? `No type is given for ${state.topic}, and nobody else publishes on it.`
            : 'No topic is given.',
        ),
      );
      return;
    }
    const card = new PublisherCard(this.connection, this.host, state, this.easy, () =>
      this.drop(card),
    );
    this.cards.push(card);
    this.empty.remove();
    this.list.append(card.element);
    this.host.touched();
  }

  private drop(card: PublisherCard): void {
    card.remove();
    this.cards.splice(this.cards.indexOf(card), 1);
    if (this.cards.length === 0) this.list.append(this.empty);
    this.host.touched();
  }

  private async typeNames(): Promise<string[]> {
    const names = await this.ask('type.list', { kind: 'msg' });
    return Array.isArray(names) ? names.map(String) : [];
  }
}

function readState(value: JsonObject): PublisherState {
  return {
    id: textOf(value, 'id'),
    topic: textOf(value, 'topic'),
    type: textOf(value, 'type'),
    rate_hz: numberOf(value, 'rate_hz', 1),
    texts: value.texts ?? {},
    ranges: value.ranges ?? {},
  };
}
