/** The page's WebSocket: calls, streams and a connection that comes back by itself. */

import { Channel, type ChannelHandlers, type StatusLevel } from './channel';
import { CallError } from './errors';
import { readFrame } from './binary_frame';
import type { Hello, Show } from './generated/messages';
import { serverPath } from './server_path';
import { isObject, numberOf, textOf, type Json, type JsonObject } from './json';

export type ConnectionState = 'connecting' | 'open' | 'lost';

interface Waiting {
  resolve(value: Json): void;
  reject(error: CallError): void;
}

const FIRST_DELAY_MS = 300;
const LAST_DELAY_MS = 4000;

/**
 * A connection to the Studio server.
 *
 * Streams stay open through a loss of the connection: they are opened again with their latest
 * parameters. Calls that were under way are rejected, because nobody knows whether they took place.
 */
export class Connection {
  state: ConnectionState = 'connecting';
  hello: Hello | null = null;
  private socket: WebSocket | null = null;
  private delay_ms = FIRST_DELAY_MS;
  private lastCall = 0;
  private lastChannel = 0;
  private readonly waiting = new Map<number, Waiting>();
  private readonly byNumber = new Map<number, Channel>();
  private readonly channels = new Set<Channel>();
  private readonly unsent = new Map<number, string>();
  private readonly stateListeners = new Set<(state: ConnectionState) => void>();
  private readonly helloListeners = new Set<(hello: Hello, previous: Hello | null) => void>();
  private readonly showListeners = new Set<(panel: string, params: JsonObject) => void>();

  constructor(private readonly url: string) {
    this.connect();
  }

  /** Asks the server for something; rejects with a `CallError`. Waits while there is no connection. */
  call(method: string, params: JsonObject = {}): Promise<Json> {
    const id = ++this.lastCall;
    const text = JSON.stringify({ op: 'call', id, method, params });
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      if (this.state === 'open') this.socket?.send(text);
      else this.unsent.set(id, text);
    });
  }

  /** Opens a stream, now or as soon as there is a connection. */
  open(stream: string, params: JsonObject, handlers: ChannelHandlers): Channel {
    const wire = {
      send: (message: JsonObject) => this.send(message),
      reopen: (channel: Channel) => this.announce(channel),
      forget: (channel: Channel) => this.forget(channel),
    };
    const channel = new Channel(wire, stream, params, handlers);
    this.channels.add(channel);
    if (this.state === 'open') this.announce(channel);
    return channel;
  }

  /** Calls back at every change of state, and now. Returns what ends it. */
  onState(listener: (state: ConnectionState) => void): () => void {
    this.stateListeners.add(listener);
    listener(this.state);
    return () => this.stateListeners.delete(listener);
  }

  /** Calls back at every greeting of a server, with the one before. */
  onHello(listener: (hello: Hello, previous: Hello | null) => void): () => void {
    this.helloListeners.add(listener);
    if (this.hello) listener(this.hello, null);
    return () => this.helloListeners.delete(listener);
  }

  /** Calls back when a command asks for a panel. */
  onShow(listener: (panel: string, params: JsonObject) => void): () => void {
    this.showListeners.add(listener);
    return () => this.showListeners.delete(listener);
  }

  /** Drops the connection; it comes back by itself. For tests and for "reconnect now". */
  drop(): void {
    this.delay_ms = FIRST_DELAY_MS;
    this.socket?.close();
  }

  private connect(): void {
    const socket = new WebSocket(this.url);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event) => this.receive(event.data as string | ArrayBuffer);
    socket.onclose = () => this.lose();
    this.socket = socket;
  }

  private lose(): void {
    this.socket = null;
    this.byNumber.clear();
    this.lastChannel = 0;
    for (const channel of [...this.channels]) this.suspend(channel);
    for (const [id, call] of this.waiting) {
      if (this.unsent.has(id)) continue;
      this.waiting.delete(id);
      call.reject(new CallError('The connection to the server was lost before it answered.'));
    }
    this.become('lost');
    setTimeout(() => this.connect(), this.delay_ms);
    this.delay_ms = Math.min(this.delay_ms * 1.7, LAST_DELAY_MS);
  }

  private suspend(channel: Channel): void {
    const begun = channel.number !== 0;
    channel.renumber(0);
    if (!channel.once || !begun) return;
    this.channels.delete(channel);
    channel.handlers.onEnded?.(new CallError('The connection to the server was lost.'));
  }

  private become(state: ConnectionState): void {
    this.state = state;
    for (const listener of this.stateListeners) listener(state);
  }

  private send(message: JsonObject): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private announce(channel: Channel): void {
    if (this.state !== 'open') return;
    channel.renumber(++this.lastChannel);
    this.byNumber.set(channel.number, channel);
    this.send({ op: 'open', ch: channel.number, stream: channel.stream, params: channel.params });
  }

  private forget(channel: Channel): void {
    this.channels.delete(channel);
    this.byNumber.delete(channel.number);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') {
      const frame = readFrame(data);
      const channel = this.byNumber.get(frame.channel);
      channel?.deliver(frame, channel.handlers.onFrame);
      return;
    }
    const message: unknown = JSON.parse(data);
    if (isObject(message)) this.understand(message);
  }

  private understand(message: JsonObject): void {
    const channel = this.byNumber.get(numberOf(message, 'ch'));
    switch (message.op) {
      case 'hello':
        return this.greet(message);
      case 'result':
        return this.answer(message, (call) => call.resolve(message.value ?? null));
      case 'error':
        return this.answer(message, (call) => call.reject(CallError.from(message.error)));
      case 'show':
        return this.show(message);
      case 'data':
        return channel?.deliver(message.value ?? null, channel.handlers.onData);
      case 'opened':
        return channel?.handlers.onOpened?.(message.info ?? null);
      case 'status':
        return channel?.handlers.onStatus?.(message.level as StatusLevel, textOf(message, 'text'));
      case 'failed':
        return this.end(channel, () => channel?.handlers.onFailed?.(CallError.from(message.error)));
      case 'ended':
        return this.end(channel, () =>
          channel?.handlers.onEnded?.(message.error ? CallError.from(message.error) : null),
        );
    }
  }

  private greet(message: JsonObject): void {
    const previous = this.hello;
    this.hello = message as unknown as Hello;
    this.delay_ms = FIRST_DELAY_MS;
    this.become('open');
    for (const channel of this.channels) this.announce(channel);
    for (const text of this.unsent.values()) this.socket?.send(text);
    this.unsent.clear();
    for (const listener of this.helloListeners) listener(this.hello, previous);
  }

  private answer(message: JsonObject, settle: (call: Waiting) => void): void {
    const id = numberOf(message, 'id');
    const call = this.waiting.get(id);
    this.waiting.delete(id);
    if (call) settle(call);
  }

  private show(message: JsonObject): void {
    const { panel, params } = message as unknown as Show;
    for (const listener of this.showListeners) listener(panel, params);
  }

  private end(channel: Channel | undefined, tell: () => void): void {
    if (!channel) return;
    this.byNumber.delete(channel.number);
    channel.renumber(0);
    tell();
  }
}

/** Where this page's WebSocket is; a token of the page's own address goes along. */
export function socketUrl(place: Location = location): string {
  const scheme = place.protocol === 'https:' ? 'wss' : 'ws';
  const token = new URLSearchParams(place.search).get('token');
  const query = token ? `?token=${encodeURIComponent(token)}` : '';
  return `${scheme}://${place.host}${serverPath('/ws', place)}${query}`;
}
