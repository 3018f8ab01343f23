/** The graph value of the server, kept once for all panels. */

import type { Connection } from './connection';
import { isObject, type Json } from './json';

export interface NodeValue { name: string; namespace: string; publishes: string[]; subscribes: string[]; serves: string[] }
export interface TopicValue { name: string; type: string; publishers: string[]; subscribers: string[]; hidden?: boolean }
export interface ServiceValue { name: string; type: string; nodes: string[] }
export interface ActionValue { name: string; type: string; servers: string[]; clients: string[] }

/** Who speaks with whom. */
export interface GraphValue {
  nodes: NodeValue[];
  topics: TopicValue[];
  services: ServiceValue[];
  actions: ActionValue[];
}

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
  topicsOf(types: readonly string[]): TopicValue[] {
    return this.value.topics.filter((topic) => types.includes(shortType(topic.type)));
  }

  private take(value: Json): void {
    if (!isObject(value)) return;
    const whole: GraphValue = { ...EMPTY, ...(value as unknown as Partial<GraphValue>) };
    this.value = { ...whole, nodes: whole.nodes.filter((node) => !HIDDEN.test(node.name)) };
    for (const listener of this.listeners) listener(this.value);
  }
}

/** `sensor_msgs/msg/Image` as `sensor_msgs/Image`. */
export function shortType(type: string): string {
  return type.replace(/\/(msg|srv|action)\//, '/');
}
