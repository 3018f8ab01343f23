/** The graph value of the server, kept once for all panels. */

import type { Connection } from './connection';
import type { GraphValue, TopicRow } from './generated/messages';
import { isObject, type Json } from './json';

/** Nodes whose last name begins with an underscore are hidden, as in ROS 2: this page's own is one. */
const HIDDEN = /\/_[^/]*$/;
const EMPTY: GraphValue = { nodes: [], topics: [], services: [], actions: [] };

/** The newest graph value and who wants to know of changes. */
export class GraphStore {
  value: GraphValue = EMPTY;
  private readonly listeners = new Set<(value: GraphValue) => void>();

  constructor(connection: Connection) {
    connection.open('graph', {}, { onData: (value) => this.take(value) });
  }

  /** Calls back at every change, and now. Returns what ends it. */
  watch(listener: (value: GraphValue) => void): () => void {
    this.listeners.add(listener);
    listener(this.value);
    return () => this.listeners.delete(listener);
  }

  /** The type of a topic, or nothing. */
  typeOf(topic: string): string | undefined {
    return this.value.topics.find((each) => each.name === topic)?.type;
  }

  /** Topics of one of some types, by their names without package's `msg/`. */
  topicsOf(types: readonly string[]): TopicRow[] {
    return this.value.topics.filter((topic) => types.includes(shortType(topic.type)));
  }

  private take(value: Json): void {
    if (!isObject(value)) return;
    const whole = value as unknown as GraphValue;
    this.value = { ...whole, nodes: whole.nodes.filter((node) => !HIDDEN.test(node.name)) };
    for (const listener of this.listeners) listener(this.value);
  }
}

/** `sensor_msgs/msg/Image` as `sensor_msgs/Image`. */
export function shortType(type: string): string {
  return type.replace(/\/(msg|srv|action)\//, '/');
}
