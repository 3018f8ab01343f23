/** How tools name message types: ROS 2's way where the graph speaks ROS 2, else ROS 1's. */
import type { GraphStore } from '../graph_store';
import type { JsonObject } from '../json';

/** Do the topics carry ROS 2's type names? */
export function speaksRos2(graph: GraphStore): boolean {
  return graph.value.topics.some((topic) => topic.type.includes('/msg/') && !topic.hidden);
}

/** `geometry_msgs/Pose` as this graph writes it. */
export function typeFor(graph: GraphStore, type: string): string {
  return speaksRos2(graph) ? type.replace('/', '/msg/') : type;
}

/** A header in a frame; the server fills in the time. */
export function stampedHeader(frame: string): JsonObject {
  return { frame_id: frame };
}
