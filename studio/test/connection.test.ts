import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Connection, socketUrl } from '../src/connection';
import { serverPath } from '../src/server_path';
import type { JsonObject } from '../src/json';

/** A WebSocket whose server is the test. */
class Socket {
  static readonly OPEN = 1;
  static all: Socket[] = [];
  static get last(): Socket {
    return Socket.all[Socket.all.length - 1];
  }
  readyState = 1;
  binaryType = '';
  readonly sent: JsonObject[] = [];
  onmessage: (event: { data: string | ArrayBuffer }) => void = () => undefined;
  onclose: () => void = () => undefined;

  constructor(readonly url: string) {
    Socket.all.push(this);
  }

  send(text: string): void {
    this.sent.push(JSON.parse(text) as JsonObject);
  }

  close(): void {
    this.onclose();
  }

  say(message: JsonObject): void {
    this.onmessage({ data: JSON.stringify(message) });
  }
}

beforeEach(() => {
  vi.useFakeTimers();
  Socket.all = [];
  vi.stubGlobal('WebSocket', Socket);
  vi.stubGlobal('requestAnimationFrame', (draw: (now: number) => void) => setTimeout(draw, 16));
});

afterEach(() => {
  vi.useRealTimers();
});

function opened(): Connection {
  const connection = new Connection('ws://here/ws');
  Socket.last.say({ op: 'hello' });
  return connection;
}

test('a call waits for the greeting and is answered by its number', async () => {
  const connection = new Connection('ws://here/ws');
  const answer = connection.call('node.list', { all: true });
  expect(Socket.last.sent).toEqual([]);
  Socket.last.say({ op: 'hello' });
  expect(Socket.last.sent).toEqual([
    { op: 'call', id: 1, method: 'node.list', params: { all: true } },
  ]);
  Socket.last.say({ op: 'result', id: 1, value: ['/a'] });
  expect(await answer).toEqual(['/a']);
});

test('a refused call rejects with the reason of the server', async () => {
  const answer = opened().call('node.kill');
  Socket.last.say({ op: 'error', id: 1, error: { message: 'No node', hint: '', known: [] } });
  await expect(answer).rejects.toThrow('No node');
});

test('a call under way is rejected when the connection is lost, for nobody knows what became of it', async () => {
  const answer = opened().call('world.reset');
  Socket.last.close();
  await expect(answer).rejects.toThrow('The connection to the server was lost before it answered.');
});

test('streams are opened again with their newest parameters', () => {
  const connection = opened();
  const channel = connection.open('topic.echo', { topic: '/a' }, {});
  channel.change({ topic: '/b' });
  Socket.last.close();
  expect(connection.state).toBe('lost');
  vi.advanceTimersByTime(300);
  Socket.last.say({ op: 'hello' });
  expect(Socket.all.length).toBe(2);
  expect(Socket.last.sent).toEqual([
    { op: 'open', ch: 1, stream: 'topic.echo', params: { topic: '/b' } },
  ]);
});

test('an action under way is not sent a second time', () => {
  const ended = vi.fn();
  opened().open('action', { goal: {} }, { onEnded: ended });
  Socket.last.close();
  vi.advanceTimersByTime(300);
  Socket.last.say({ op: 'hello' });
  expect(Socket.last.sent).toEqual([]);
  expect(ended).toHaveBeenCalledOnce();
});

test('the page tries to come back less and less often, up to every four seconds', () => {
  opened();
  const waits: number[] = [];
  for (let round = 0; round < 7; round++) {
    const before = Socket.all.length;
    Socket.last.close();
    const began = Date.now();
    while (Socket.all.length === before) vi.advanceTimersByTime(10);
    waits.push(Date.now() - began);
  }
  expect(waits).toEqual([300, 510, 870, 1480, 2510, 4000, 4000]);
});

test('a latest-wins stream is acknowledged once it is drawn, and not while it is hidden', () => {
  const drawn: unknown[] = [];
  const channel = opened().open('topic.echo', {}, { onData: (value) => void drawn.push(value) });
  const acknowledged = () => Socket.last.sent.filter((message) => message.op === 'ack').length;
  Socket.last.say({ op: 'data', ch: 1, value: 5 });
  expect([drawn, acknowledged()]).toEqual([[5], 0]);
  vi.advanceTimersByTime(16);
  expect(acknowledged()).toBe(1);
  channel.hold(true);
  Socket.last.say({ op: 'data', ch: 1, value: 6 });
  vi.advanceTimersByTime(16);
  expect(acknowledged()).toBe(1);
  channel.hold(false);
  expect(acknowledged()).toBe(2);
});

test('a binary frame goes to the channel of its header', () => {
  const counts: number[] = [];
  opened().open('world.poses', {}, { onFrame: (frame) => void counts.push(frame.count) });
  for (const channel of [1, 9]) {
    const header = new DataView(new ArrayBuffer(16));
    header.setUint16(0, channel, true);
    header.setUint32(4, 3, true);
    Socket.last.onmessage({ data: header.buffer });
  }
  expect(counts).toEqual([3]);
});

test("the token of the page's address goes along", () => {
  const place = (search: string, protocol = 'http:') =>
    ({ protocol, host: 'robot:8090', pathname: '/', search }) as Location;
  expect(socketUrl(place(''))).toBe('ws://robot:8090/ws');
  expect(socketUrl(place('?token=a%2Bb', 'https:'))).toBe('wss://robot:8090/ws?token=a%2Bb');
});

test('a page in a folder of the server finds everything below it', () => {
  const place = {
    protocol: 'http:',
    host: 'here:1',
    pathname: '/frame/abc/',
    search: '',
  } as Location;
  expect(socketUrl(place)).toBe('ws://here:1/frame/abc/ws');
  expect(serverPath('/mesh/base', place)).toBe('/frame/abc/mesh/base');
});
