/** What all panels share: streams that are held while the panel is hidden, and a clean end. */

import type { Channel, ChannelHandlers } from '../channel';
import type { Connection } from '../connection';
import type { Json, JsonObject } from '../json';
import type { Panel, PanelHost } from '../panel';
import { h } from '../widgets/dom';

/** A panel with its connection and host. */
export abstract class BasePanel implements Panel {
  readonly id: string;
  readonly element: HTMLElement = h('div', { class: 'panel' });
  abstract readonly title: string;
  protected visible = false;
  private readonly channels = new Set<Channel>();
  private readonly ends: (() => void)[] = [];

  constructor(
    protected readonly connection: Connection,
    protected readonly host: PanelHost,
  ) {
    this.id = host.id;
  }

  open(_params: JsonObject): void {}

  state(): JsonObject {
    return {};
  }

  shown(visible: boolean): void {
    this.visible = visible;
    for (const channel of this.channels) channel.hold(!visible);
  }

  dispose(): void {
    for (const channel of this.channels) channel.close();
    for (const end of this.ends) end();
  }

  /** Opens a stream that ends with the panel. Failures are shown unless the handlers take them. */
  protected stream(name: string, params: JsonObject, handlers: ChannelHandlers): Channel {
    const tell = (problem: unknown) => {
      if (problem) this.host.fail(problem, this.title);
    };
    const channel = this.connection.open(name, params, {
      onFailed: tell,
      onEnded: tell,
      ...handlers,
    });
    this.channels.add(channel);
    if (!this.visible) channel.hold(true);
    return channel;
  }

  /** Ends one stream before its panel. */
  protected endStream(channel: Channel | null | undefined): void {
    if (!channel) return;
    channel.close();
    this.channels.delete(channel);
  }

  /** Runs when the panel is closed. */
  protected atEnd(end: () => void): void {
    this.ends.push(end);
  }

  /** Asks the server and shows what goes wrong; null then. */
  protected async ask(method: string, params: JsonObject = {}): Promise<Json> {
    try {
      return await this.connection.call(method, params);
    } catch (problem) {
      this.host.fail(problem);
      return null;
    }
  }
}
