/** What the server sends, as its Python types declare it. Generated: `python -m gazelle.studio.typescript`. */
import type { Json } from '../json';

/** The graph that is looked at. */
export interface GraphPlace {
  port: number;
  domain: number;
}

/** The server's first words. */
export interface Hello {
  op: "hello";
  version: string;
  session: string;
  /** the server's own on the graph. */
  node: string;
  graph: GraphPlace;
  /** those that commands asked for. */
  panels: string[];
}

/** A command asks for a panel. */
export interface Show {
  op: "show";
  panel: string;
  params: Record<string, Json>;
}

/** What went wrong. */
export interface ErrorValue {
  message: string;
  /** what to do about it. */
  hint?: string;
  /** what exists instead. */
  known?: string[];
}

/** A node with the names of its topics and services. */
export interface NodeRow {
  name: string;
  namespace: string;
  publishes: string[];
  subscribes: string[];
  serves: string[];
}

/** A topic with the names of its nodes. */
export interface TopicRow {
  name: string;
  type: string;
  publishers: string[];
  subscribers: string[];
  hidden: boolean;
}

/** A service with the names of its nodes. */
export interface ServiceRow {
  name: string;
  type: string;
  nodes: string[];
}

/** An action with the names of its nodes. */
export interface ActionRow {
  name: string;
  type: string;
  servers: string[];
  clients: string[];
}

/** Who speaks with whom. */
export interface GraphValue {
  nodes: NodeRow[];
  topics: TopicRow[];
  services: ServiceRow[];
  actions: ActionRow[];
}

/** What came on a topic in the last seconds. */
export interface TopicStats {
  topic: string;
  hz: number;
  bytes_per_s: number;
  /** null where messages have no header. */
  delay_s: number | null;
  /** since somebody looks. */
  count: number;
}

/** A message of the stream `topic.echo`; its long arrays are cut. */
export interface EchoedMessage {
  type: string;
  stamp_s: number;
  count: number;
  message: Json;
}

/** What is told when the stream `topic.plot` is open: the names of its curves. */
export interface PlotCurves {
  curves: string[];
}

/** New points of a curve. */
export interface PlotPoints {
  /** its place among the names. */
  curve: number;
  /** seconds. */
  t: number[];
  /** values; null for what is no number. */
  v: (number | null)[];
}

/** What a node said, of the stream `rosout`. */
export interface LogLine {
  stamp_s: number;
  level: string;
  /** of the node. */
  name: string;
  message: string;
  file: string;
  function: string;
  line: number;
}

/** A frame of the stream `tf`, in the order of the poses. */
export interface TfFrame {
  name: string;
  parent: string;
  static: boolean;
}

/** What the stream `tf` tells ahead of poses whenever it changes. */
export interface FrameNames {
  frames: TfFrame[];
}

/** A frame of the stream `tf.tree`. */
export interface FrameRow {
  frame: string;
  parent: string;
  /** null where it is static. */
  rate_hz: number | null;
  /** of the newest transform; null where it is static. */
  age_s: number | null;
  /** the node that says so. */
  broadcaster: string;
  static: boolean;
}

/** What the page knows of a display before it draws one. */
export interface DisplayRow {
  name: string;
  about: string;
  /** messages it shows, as `sensor_msgs/LaserScan`; none for those without a topic. */
  types: string[];
  /** what other versions of RViz call it. */
  aliases: string[];
  /** it reads the stream `display`. */
  streams: boolean;
  /** the display whose drawing it takes, usually its own. */
  drawn_as: string;
}

/** Displays that pip packages add, and one sentence for each that cannot be shown. */
export interface AddedDisplays {
  displays: DisplayRow[];
  problems: string[];
}
