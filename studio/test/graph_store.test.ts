import { expect, test } from 'vitest';
import type { ChannelHandlers } from '../src/channel';
import type { Connection } from '../src/connection';
import { GraphStore, shortType } from '../src/graph_store';
import { graphOf, nodeRow, topicRow } from './graphs';

/** A store and what hands a value to it, as its stream does. */
function storeOf(): { store: GraphStore; tell: (value: unknown) => void } {
  let handlers: ChannelHandlers = {};
  const open = (_stream: string, _params: unknown, given: ChannelHandlers): void => {
    handlers = given;
  };
  const store = new GraphStore({ open } as unknown as Connection);
  return { store, tell: (value) => void handlers.onData?.(value as never) };
}

test('whoever watches hears the value at once, of every change, and nothing afterwards', () => {
  const { store, tell } = storeOf();
  const seen: number[] = [];
  const end = store.watch((value) => seen.push(value.nodes.length));
  tell(graphOf({ nodes: [nodeRow('/a')] }));
  end();
  tell(graphOf({}));
  expect(seen).toEqual([0, 1]);
});

test('nodes whose last name begins with an underscore are hidden', () => {
  const { store, tell } = storeOf();
  tell(graphOf({ nodes: [nodeRow('/_studio'), nodeRow('/_ns/talker'), nodeRow('/ns/_own')] }));
  expect(store.value.nodes.map((node) => node.name)).toEqual(['/_ns/talker']);
});

test('topics are found by type without the package part of ROS 2', () => {
  const { store, tell } = storeOf();
  tell(
    graphOf({
      topics: [topicRow('/scan', { type: 'sensor_msgs/msg/LaserScan' }), topicRow('/odom')],
    }),
  );
  expect(store.topicsOf(['sensor_msgs/LaserScan']).map((topic) => topic.name)).toEqual(['/scan']);
  expect(store.typeOf('/scan')).toBe('sensor_msgs/msg/LaserScan');
  expect(store.typeOf('/none')).toBeUndefined();
});

test('what is no graph changes nothing', () => {
  const { store, tell } = storeOf();
  tell(graphOf({ nodes: [nodeRow('/a')] }));
  tell(null);
  expect(store.value.nodes.length).toBe(1);
});

test('types of messages, services and actions lose their middle', () => {
  expect(['a/msg/B', 'a/srv/B', 'a/action/B', 'a/B'].map(shortType)).toEqual([
    'a/B',
    'a/B',
    'a/B',
    'a/B',
  ]);
});
