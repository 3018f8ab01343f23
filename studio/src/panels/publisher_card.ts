/** One publisher: topic, rate, on or off, its message. */

import type { Connection } from '../connection';
import { inOneLine } from '../errors';
import type { PublisherCount, PublisherRow, TypeValue } from '../generated/messages';
import type { Json, JsonObject } from '../json';
import type { PanelHost } from '../panel';
import { button, h, setText } from '../widgets/dom';
import { MessageForm } from '../widgets/message_form';
import { SliderForm } from '../widgets/slider_form';

/** What a layout keeps of a publisher. */
export interface PublisherState {
  id?: string;
  topic: string;
  type: string;
  rate_hz: number;
  texts?: Json;
  ranges?: Json;
}

const SEND_AFTER_MS = 60;
let count = 0;

/** A publisher of the server with its form. */
export class PublisherCard {
  readonly element: HTMLElement;
  /** Kept with the layout: after a reload the card finds its publisher again. */
  private readonly id: string;
  private form: MessageForm | SliderForm | null = null;
  private enabled = false;
  private made = false;
  private pending = 0;
  private poll = 0;
  private readonly rate: HTMLInputElement;
  private readonly tick = h('input', { type: 'checkbox', title: 'Publish repeatedly' });
  private readonly sent = h('output', { class: 'dim', 'aria-label': 'Published' });
  private readonly problem = h('div', { class: 'problem', role: 'alert' });

  constructor(
    private readonly connection: Connection,
    private readonly host: PanelHost,
    private readonly start: PublisherState,
    private readonly easy: boolean,
    removed: () => void,
  ) {
    this.id = start.id || `page-${Date.now().toString(36)}-${++count}`;
    this.rate = h('input', {
      type: 'number',
      min: 0,
      step: 'any',
      value: start.rate_hz,
      class: 'small',
      'aria-label': `Rate of ${start.topic} in Hz`,
      title: 'Rate in Hz',
    });
    this.rate.addEventListener('change', () => this.changed());
    const body = h('div', { class: 'card-body' }, 'Loading the definition …');
    this.element = h(
      'section',
      { class: 'card', 'aria-label': `Publisher ${start.topic}` },
      h(
        'div',
        { class: 'card-head' },
        this.tick,
        h('strong', {}, start.topic),
        h('span', { class: 'dim ellipsis' }, start.type),
        h('span', { class: 'spacer' }),
        this.sent,
        this.rate,
        h('span', { class: 'dim' }, 'Hz'),
        button('Publish once', () => void this.once(), { icon: 'send' }),
        button('', removed, { icon: 'close', title: `Remove ${start.topic}`, class: 'ghost' }),
      ),
      this.problem,
      body,
    );
    this.tick.setAttribute('aria-label', `Publish ${start.topic} repeatedly`);
    this.tick.addEventListener('change', () => {
      this.enabled = this.tick.checked;
      void this.send();
    });
    void this.load(body);
  }

  /** What a layout keeps. */
  state(): PublisherState {
    const sliders = this.form instanceof SliderForm ? { ranges: this.form.ranges() } : {};
    return {
      id: this.id,
      topic: this.start.topic,
      type: this.start.type,
      rate_hz: Number(this.rate.value),
      texts: this.form ? this.form.texts() : (this.start.texts ?? {}),
      ...sliders,
    };
  }

  /** Ends the publisher. */
  remove(): void {
    clearTimeout(this.pending);
    clearInterval(this.poll);
    this.element.remove();
    if (this.made)
      this.connection
        .call('publisher.remove', { id: this.id })
        .catch((problem: unknown) => this.host.fail(problem));
  }

  private async load(body: HTMLElement): Promise<void> {
    try {
      const type = await this.connection.call('type.get', { type: this.start.type, kind: 'msg' });
      const { fields } = type as unknown as TypeValue;
      const changed = () => this.changed();
      this.form = this.easy
        ? new SliderForm(fields, this.start.ranges ?? {}, changed)
        : new MessageForm(fields, { expressions: true, changed });
      this.form.fill(this.start.texts);
      body.replaceChildren(this.form.element);
      if (this.start.id) await this.findAgain();
    } catch (problem) {
      body.replaceChildren();
      setText(this.problem, inOneLine(problem));
    }
  }

  private changed(): void {
    this.host.touched();
    if (!this.made) return;
    clearTimeout(this.pending);
    this.pending = window.setTimeout(() => void this.send(), SEND_AFTER_MS);
  }

  private async once(): Promise<void> {
    if (!this.form) return;
    if (Object.keys(this.form.expressions()).length > 0) {
      setText(this.problem, 'An expression needs a rate: tick the publisher, or give numbers.');
      return;
    }
    await this.attempt('topic.publish', {
      topic: this.start.topic,
      type: this.start.type,
      message: this.form.message(),
    });
  }

  private async send(): Promise<void> {
    if (!this.form) return;
    this.made = true;
    const params: JsonObject = {
      id: this.id,
      topic: this.start.topic,
      type: this.start.type,
      rate_hz: Number(this.rate.value),
      message: this.form.message(),
      expressions: this.form.expressions(),
      enabled: this.enabled,
    };
    const made = (await this.attempt('publisher.set', params)) as unknown as PublisherCount | null;
    if (made) this.tellCount(made);
    this.watch();
  }

  private async findAgain(): Promise<void> {
    const mine = await this.row();
    if (!mine) return;
    this.made = true;
    this.enabled = mine.enabled;
    this.tick.checked = this.enabled;
    if (this.enabled) this.watch();
  }

  private watch(): void {
    clearInterval(this.poll);
    if (this.enabled) this.poll = window.setInterval(() => void this.showCount(), 1000);
  }

  private async row(): Promise<PublisherRow | null> {
    const list = (await this.connection.call('publisher.list').catch(() => null)) as unknown as
      | PublisherRow[]
      | null;
    return list?.find((each) => each.id === this.id) ?? null;
  }

  private async showCount(): Promise<void> {
    const mine = await this.row();
    if (!mine) return;
    this.tellCount(mine);
    if (mine.error) setText(this.problem, mine.error);
  }

  private tellCount({ count: sent }: PublisherCount): void {
    setText(this.sent, `${sent} sent`);
  }

  /** Asks the server and shows what goes wrong; null then. */
  private async attempt(method: string, params: JsonObject): Promise<Json> {
    try {
      const value = await this.connection.call(method, params);
      setText(this.problem, '');
      return value;
    } catch (problem) {
      setText(this.problem, inOneLine(problem));
      return null;
    }
  }
}
