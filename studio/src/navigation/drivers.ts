/** What drives a robot to goals: Nav2's actions or move_base's, and what their feedback says. */
import { seconds, part, list, vector } from '../displays/message_fields';
import { shortType, type GraphStore } from '../graph_store';
import type { JsonObject } from '../json';

/** How many waypoints are driven to. */
export type Mode = 'goal' | 'through' | 'follow';

/** One goal for an action server. */
export interface Order {
  action: string;
  type: string;
  goal: JsonObject;
}

/** What feedback says, in one form; what it does not say is missing. */
export interface Progress {
  distance_m?: number;
  eta_s?: number;
  taken_s?: number;
  recoveries?: number;
  /** Waypoints that are still to be reached. */
  remaining?: number;
  /** The number of the waypoint that is driven to. */
  current?: number;
  position?: { x: number; y: number };
}

const TYPES: Record<Mode, readonly string[]> = {
  goal: ['nav2_msgs/NavigateToPose', 'move_base_msgs/MoveBase'],
  through: ['nav2_msgs/NavigateThroughPoses'],
  follow: ['nav2_msgs/FollowWaypoints'],
};

/** The namespaces of the robots that can be sent somewhere, the servers' names without `navigate_to_pose` or `move_base`. */
export function robots(graph: GraphStore): string[] {
  const served = graph.value.actions.filter(
    (each) => each.servers.length > 0 && TYPES.goal.includes(shortType(each.type)),
  );
  return [...new Set(served.map((each) => each.name.replace(/\/[^/]*$/, '')))].sort();
}

/** Is there a server for a mode? */
export function server(
  graph: GraphStore,
  robot: string,
  mode: Mode,
): { name: string; type: string } | undefined {
  return graph.value.actions.find(
    (each) =>
      each.servers.length > 0 &&
      TYPES[mode].includes(shortType(each.type)) &&
      each.name.replace(/\/[^/]*$/, '') === robot,
  );
}

/** The goal of a mode for some poses (`geometry_msgs/PoseStamped`). */
export function order(
  found: { name: string; type: string },
  poses: readonly JsonObject[],
  loops: number,
): Order {
  const goals: Record<string, JsonObject> = {
    'nav2_msgs/NavigateToPose': { pose: poses[0] },
    'move_base_msgs/MoveBase': { target_pose: poses[0] },
    'nav2_msgs/NavigateThroughPoses': { poses: [...poses] },
    'nav2_msgs/FollowWaypoints': { poses: [...poses], number_of_loops: loops },
  };
  return { action: found.name, type: found.type, goal: goals[shortType(found.type)] };
}

/** Read the feedback of any of the actions. */
export function progress(feedback: JsonObject): Progress {
  const found: Progress = {};
  const copy = (from: string, to: 'distance_m' | 'recoveries' | 'remaining' | 'current'): void => {
    if (typeof feedback[from] === 'number') found[to] = feedback[from];
  };
  copy('distance_remaining', 'distance_m');
  copy('number_of_recoveries', 'recoveries');
  copy('number_of_poses_remaining', 'remaining');
  copy('current_waypoint', 'current');
  if ('estimated_time_remaining' in feedback)
    found.eta_s = seconds(feedback.estimated_time_remaining);
  if ('navigation_time' in feedback) found.taken_s = seconds(feedback.navigation_time);
  const base = 'base_position' in feedback ? 'base_position' : 'current_pose';
  if (base in feedback) found.position = vector(part(feedback, base, 'pose').position);
  return found;
}

/** The numbers of the waypoints that a result says were missed. */
export function missed(result: JsonObject): number[] {
  return list<{ index: number } | number>(result, 'missed_waypoints').map((each) =>
    typeof each === 'number' ? each : each.index,
  );
}
