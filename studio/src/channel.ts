/** One open stream of the page: it lives on through reconnections until it is closed. */

import type { CallError } from './errors';
import type { Frame } from './binary_frame';
import { LATEST_STREAMS } from './generated/streams';
import type { Json, JsonObject } from './json';

export type StatusLevel = 'ok' | 'warn' | 'error';

/**
 * What a stream tells. A handler that returns a promise delays the acknowledgement until the
 * promise is settled; one that returns nothing is acknowledged at the next animation frame.
 */
export interface ChannelHandlers {
  onData?: (value: Json) => void | Promise<void>;
  onFrame?: (frame: Frame) => void | Promise<void>;
  /** The server has opened the stream, at first and after every reconnection. */
  onOpened?: (info: Json) => void;
  /** The stream could not be opened. It is tried again after a reconnection or `change`. */
  onFailed?: (error: CallError) => void;
  onStatus?: (level: StatusLevel, text: string) => void;
  onEnded?: (error: CallError | null) => void;
}

/** What a channel needs of its connection. */
export interface ChannelWire {
  send(message: JsonObject): void;
  reopen(channel: Channel): void;
  forget(channel: Channel): void;
}

/** Streams that do something once: to open them again would do it again. */
const ONCE = new Set(['action']);

/** A stream of the server. Made by `Connection.open`. */
export class Channel {
  /** The number on the present connection; 0 while there is none. */
  number = 0;
  private owed = 0;
  private held = false;
  private closed = false;
  private readonly latest: boolean;

  constructor(
    private readonly wire: ChannelWire,
    readonly stream: string,
    public params: JsonObject,
    readonly handlers: ChannelHandlers,
  ) {
    this.latest = LATEST_STREAMS.has(stream);
  }

  /** New parameters, without a gap in the data. */
  change(params: JsonObject): void {
    if (this.closed) return;
    this.params = params;
    if (this.number) this.wire.send({ op: 'change', ch: this.number, params });
    else this.wire.reopen(this);
  }

  /** Ends the stream. */
  close(): void {
    if (this.closed) return;
    this.closed = true;
    if (this.number) this.wire.send({ op: 'close', ch: this.number });
    this.wire.forget(this);
  }

  /**
   * Holds the stream back while its panel is hidden: a latest-wins stream gets no credits, so that
   * the server neither makes nor sends anything. A batch stream goes on.
   */
  hold(held: boolean): void {
    this.held = held;
    if (!held) this.payOwed();
  }

  /** Hands an item to its handler and acknowledges it once it is drawn. */
  deliver(item: Json | Frame, handler: ((item: never) => void | Promise<void>) | undefined): void {
    const at = this.number;
    const done = handler?.(item as never);
    if (!this.latest) return;
    const pay = () => this.acknowledge(at);
    if (done) done.then(pay, pay);
    else requestAnimationFrame(pay);
  }

  /** Whether the stream ends with its connection instead of being opened again. */
  get once(): boolean {
    return ONCE.has(this.stream);
  }

  /** A new connection: nothing is owed on it. */
  renumber(number: number): void {
    this.number = number;
    this.owed = 0;
  }

  private acknowledge(at: number): void {
    if (this.closed || at !== this.number || !at) return;
    this.owed += 1;
    if (!this.held) this.payOwed();
  }

  private payOwed(): void {
    if (!this.number || this.closed) return;
    for (; this.owed > 0; this.owed -= 1) this.wire.send({ op: 'ack', ch: this.number });
  }
}
