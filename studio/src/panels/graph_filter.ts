/** Which nodes, topics and ties the Node Graph shows: rqt_graph's choices. */

import type { GraphValue, TopicRow } from '../generated/messages';
import { shortType } from '../graph_store';
import type { Drawing, DrawnNode } from '../widgets/graph_drawing';

export type GraphMode = 'nodes' | 'active' | 'all';

/** What is hidden or shown. */
export interface GraphChoice {
  mode: GraphMode;
  /** Names that must occur, comma separated; a leading `-` keeps names away. */
  nodes: string;
  topics: string;
  deadSinks: boolean;
  leafTopics: boolean;
  debug: boolean;
  tf: boolean;
  images: boolean;
  params: boolean;
  unreachable: boolean;
}

/** What rqt_graph begins with. */
export const FIRST_CHOICE: GraphChoice = {
  mode: 'nodes',
  nodes: '',
  topics: '',
  deadSinks: true,
  leafTopics: true,
  debug: true,
  tf: true,
  images: false,
  params: true,
  unreachable: false,
};

const QUIET =
  /^\/(rosout(_agg)?|diagnostics(_agg)?|diag_agg|runtime_logger|statistics|clock|cpu_monitor|monitor|hd_monitor|rxloggerlevel)$|\/(rqt|rviz|rosbag|record)[^/]*$/;
const PARAMS = /\/(parameter_events|parameter_descriptions|parameter_updates)$/;

/** The graph as it is drawn. */
export function drawingOf(graph: GraphValue, choice: GraphChoice): Drawing {
  const nodeOk = matcher(choice.nodes, choice.debug);
  const topicOk = matcher(choice.topics, choice.debug);
  const topics = graph.topics.filter((topic) => topicOk(topic.name) && topicShown(topic, choice));
  const nodes = graph.nodes.map((node) => node.name).filter(nodeOk);
  const known = new Set(nodes);
  const trimmed = topics.map((topic) => ({
    ...topic,
    publishers: topic.publishers.filter((name) => known.has(name)),
    subscribers: topic.subscribers.filter((name) => known.has(name)),
  }));
  return choice.mode === 'nodes'
    ? nodesOnly(nodes, trimmed, choice)
    : nodesAndTopics(nodes, trimmed, choice);
}

function topicShown(topic: TopicRow, choice: GraphChoice): boolean {
  if (topic.hidden) return false;
  if (choice.tf && /\/tf(_static)?$/.test(topic.name)) return false;
  if (choice.params && PARAMS.test(topic.name)) return false;
  if (choice.images && /^sensor_msgs\/(Compressed)?Image$/.test(shortType(topic.type)))
    return false;
  return true;
}

function nodesOnly(nodes: string[], topics: TopicRow[], choice: GraphChoice): Drawing {
  const edges = new Map<string, { from: string; to: string; labels: string[] }>();
  for (const topic of topics) {
    for (const from of topic.publishers)
      for (const to of topic.subscribers) {
        const key = `${from}\n${to}`;
        const edge = edges.get(key) ?? { from, to, labels: [] };
        edge.labels.push(topic.name);
        edges.set(key, edge);
      }
  }
  const list = [...edges.values()].map((edge) => ({
    from: `n:${edge.from}`,
    to: `n:${edge.to}`,
    label: edge.labels.length > 3 ? `${edge.labels.length} topics` : edge.labels.join('\n'),
    title: edge.labels.join('\n'),
  }));
  const tied = new Set(list.flatMap((edge) => [edge.from, edge.to]));
  const shown = nodes.filter((name) => !choice.unreachable || tied.has(`n:${name}`));
  return { nodes: shown.map(nodeBox), edges: list };
}

function nodesAndTopics(nodes: string[], topics: TopicRow[], choice: GraphChoice): Drawing {
  const shown = topics.filter((topic) => topicKept(topic, choice));
  const edges = shown.flatMap((topic) => [
    ...topic.publishers.map((name) => ({ from: `n:${name}`, to: `t:${topic.name}` })),
    ...topic.subscribers.map((name) => ({ from: `t:${topic.name}`, to: `n:${name}` })),
  ]);
  const tied = new Set(edges.flatMap((edge) => [edge.from, edge.to]));
  const kept = nodes.filter((name) => !choice.unreachable || tied.has(`n:${name}`));
  return { nodes: [...kept.map(nodeBox), ...shown.map(topicBox)], edges };
}

/** Active topics have both ends; dead sinks nobody hears; leaf topics have one tie alone. */
function topicKept(topic: TopicRow, choice: GraphChoice): boolean {
  const { publishers, subscribers } = topic;
  if (choice.mode === 'active' && (publishers.length === 0 || subscribers.length === 0))
    return false;
  if (choice.deadSinks && subscribers.length === 0) return false;
  return !(choice.leafTopics && publishers.length + subscribers.length < 2);
}

function matcher(text: string, quiet: boolean): (name: string) => boolean {
  const parts = text
    .split(',')
    .map((part) => part.trim())
    .filter((part) => part && part !== '/');
  const away = parts.filter((part) => part.startsWith('-')).map((part) => part.slice(1));
  const wanted = parts.filter((part) => !part.startsWith('-'));
  return (name) =>
    !(quiet && QUIET.test(name)) &&
    !away.some((part) => name.includes(part)) &&
    (wanted.length === 0 || wanted.some((part) => name.includes(part)));
}

function nodeBox(name: string): DrawnNode {
  return { id: `n:${name}`, label: name, shape: 'node', title: `Node ${name}` };
}

function topicBox(topic: TopicRow): DrawnNode {
  return {
    id: `t:${topic.name}`,
    label: topic.name,
    shape: 'topic',
    title: `${topic.name}\n${topic.type}`,
  };
}
