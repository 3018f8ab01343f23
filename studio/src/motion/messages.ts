/** Messages of MoveIt as the page writes and reads them, in ROS 2's field names. */
import type * as THREE from 'three';
import { list, numbers, part, seconds } from '../displays/message_fields';
import type { Json, JsonObject } from '../json';
import { poseOf } from '../model/assembly';
import type { MotionRobot } from '../generated/messages';
import type { Positions } from './robot';

/** `moveit_msgs/MoveItErrorCodes`. */
const CODES: Record<number, string> = {
  1: 'SUCCESS',
  0: 'UNDEFINED',
  99999: 'FAILURE',
  [-1]: 'PLANNING_FAILED',
  [-2]: 'INVALID_MOTION_PLAN',
  [-3]: 'MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE',
  [-4]: 'CONTROL_FAILED',
  [-5]: 'UNABLE_TO_AQUIRE_SENSOR_DATA',
  [-6]: 'TIMED_OUT',
  [-7]: 'PREEMPTED',
  [-10]: 'START_STATE_IN_COLLISION',
  [-11]: 'START_STATE_VIOLATES_PATH_CONSTRAINTS',
  [-12]: 'GOAL_IN_COLLISION',
  [-13]: 'GOAL_VIOLATES_PATH_CONSTRAINTS',
  [-14]: 'GOAL_CONSTRAINTS_VIOLATED',
  [-15]: 'INVALID_GROUP_NAME',
  [-16]: 'INVALID_GOAL_CONSTRAINTS',
  [-17]: 'INVALID_ROBOT_STATE',
  [-18]: 'INVALID_LINK_NAME',
  [-19]: 'INVALID_OBJECT_NAME',
  [-21]: 'FRAME_TRANSFORM_FAILURE',
  [-22]: 'COLLISION_CHECKING_UNAVAILABLE',
  [-23]: 'ROBOT_STATE_STALE',
  [-24]: 'SENSOR_INFO_STALE',
  [-25]: 'COMMUNICATION_FAILURE',
  [-26]: 'START_STATE_INVALID',
  [-27]: 'GOAL_STATE_INVALID',
  [-28]: 'UNRECOGNIZED_GOAL_TYPE',
  [-29]: 'CRASH',
  [-30]: 'ABORT',
  [-31]: 'NO_IK_SOLUTION',
};
const SUCCESS = 1;
const TOLERANCE = 1e-4;

/** An answer's error code: whether all went well, and what it says. */
export interface Outcome {
  ok: boolean;
  text: string;
  why: string;
}

/** Read the field `error_code` of a result or response. */
export function outcomeOf(value: Json | undefined): Outcome {
  const error = part(value, 'error_code');
  const code = Number(error.val ?? 0);
  const why = typeof error.message === 'string' ? error.message : '';
  const name = `${CODES[code] ?? 'unknown code'} (${code})`;
  return { ok: code === SUCCESS, text: why ? `${name}: ${why}` : name, why };
}

/** A `RobotState` of joints of one variable, and of those of several. */
export function robotState(robot: MotionRobot, positions: Positions): JsonObject {
  const single = robot.joints.filter(
    (joint) => joint.variables.length === 1 && joint.name in positions,
  );
  const several = robot.joints.filter(
    (joint) => joint.variables.length > 1 && joint.variables.every((one) => one.name in positions),
  );
  return {
    joint_state: {
      name: single.map((joint) => joint.name),
      position: single.map((joint) => positions[joint.name]),
    },
    multi_dof_joint_state: {
      header: { frame_id: robot.frame },
      joint_names: several.map((joint) => joint.name),
      transforms: several.map((joint) =>
        transform(joint.variables.map((one) => positions[one.name])),
      ),
    },
    is_diff: true,
  };
}

function transform(values: number[]): JsonObject {
  const planar = values.length === 3;
  const [x, y] = values;
  const [qx, qy, qz, qw] = planar
    ? [0, 0, Math.sin(values[2] / 2), Math.cos(values[2] / 2)]
    : values.slice(3);
  return {
    translation: { x, y, z: planar ? 0 : values[2] },
    rotation: { x: qx, y: qy, z: qz, w: qw },
  };
}

/** A `geometry_msgs/Pose` of a rigid matrix. */
export function poseMessage(matrix: THREE.Matrix4): JsonObject {
  const [x, y, z, qx, qy, qz, qw] = poseOf(matrix);
  return { position: { x, y, z }, orientation: { x: qx, y: qy, z: qz, w: qw } };
}

/** `Constraints` that ask for positions of joints. */
export function jointGoal(positions: Positions, variables: readonly string[]): JsonObject {
  return {
    joint_constraints: variables.map((name) => ({
      joint_name: name,
      position: positions[name] ?? 0,
      tolerance_above: TOLERANCE,
      tolerance_below: TOLERANCE,
      weight: 1,
    })),
  };
}

/** A planned path: where the robot is at each of its points. */
export interface PlannedPath {
  start: Positions;
  times_s: number[];
  points: Positions[];
}

/** Read a `RobotTrajectory` with where it starts from. */
export function pathOf(trajectories: Json[], start: Json | undefined): PlannedPath {
  const found: PlannedPath = { start: positionsOf(start), times_s: [], points: [] };
  let begin = 0;
  for (const trajectory of trajectories) {
    const joints = part(trajectory, 'joint_trajectory');
    const names = list<string>(joints, 'joint_names');
    const last = found.points[found.points.length - 1] ?? found.start;
    for (const point of list<JsonObject>(joints, 'points')) {
      const row = numbers(point.positions);
      found.points.push({
        ...last,
        ...Object.fromEntries(names.map((name, at) => [name, row[at]])),
      });
      found.times_s.push(begin + seconds(point.time_from_start));
    }
    begin = found.times_s[found.times_s.length - 1] ?? begin;
  }
  return found;
}

/** Positions of a `RobotState`. */
export function positionsOf(state: Json | undefined): Positions {
  const joints = part(state, 'joint_state');
  const values = numbers(joints.position);
  return Object.fromEntries(list<string>(joints, 'name').map((name, at) => [name, values[at]]));
}
