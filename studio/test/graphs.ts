/** Graph values for tests. */
import type { GraphValue, NodeRow, TopicRow } from '../src/generated/messages';

export function graphOf(part: Partial<GraphValue>): GraphValue {
  return { nodes: [], topics: [], services: [], actions: [], ...part };
}

export function nodeRow(name: string): NodeRow {
  return { name, namespace: '/', publishes: [], subscribes: [], serves: [] };
}

export function topicRow(name: string, part: Partial<TopicRow> = {}): TopicRow {
  const type = 'nav_msgs/msg/Odometry';
  return { name, type, publishers: [], subscribers: [], hidden: false, ...part };
}
