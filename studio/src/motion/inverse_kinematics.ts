/** Inverse kinematics for a person who drags: by `compute_ik`, or as near as it gets. */
import * as THREE from 'three';
import { inOneLine } from '../errors';
import { outcomeOf, poseMessage, positionsOf, robotState } from './messages';
import type { MotionRobot } from '../generated/messages';
import { groupOf, variablesOf, type Kinematics, type Positions } from './robot';
import type { MotionStore } from './store';

const ROUNDS = 40;
const STEP = 1e-4;
const DAMPING = 0.02;
const MOST_STEP = 0.15;
const NEAR = 1e-5;
const QUERY = 'goal';

/** Takes poses of the goal's tip as fast as they come; answers go into the store, the newest wins. */
export class Inverse {
  private wanted: THREE.Matrix4 | null = null;
  private asking = false;

  /** @param told is called after every answer. */
  constructor(
    private readonly store: MotionStore,
    private readonly told: () => void,
  ) {}

  /** The tip shall be at a pose, of the frame of `Kinematics.poses`. */
  ask(link: string, pose: THREE.Matrix4): void {
    this.wanted = pose.clone();
    if (!this.asking) void this.work(link);
  }

  private async work(link: string): Promise<void> {
    this.asking = true;
    while (this.wanted) {
      const pose = this.wanted;
      this.wanted = null;
      try {
        await this.solve(link, pose);
      } catch (problem) {
        this.store.ikProblem = inOneLine(problem);
      }
      this.told();
    }
    this.asking = false;
  }

  private async solve(link: string, pose: THREE.Matrix4): Promise<void> {
    const { store } = this;
    const { robot, kinematics } = store;
    if (!robot || !kinematics) return;
    const answer = await store.service('compute_ik', 'GetPositionIK', {
      ik_request: {
        group_name: store.group,
        robot_state: robotState(robot, store.positions(QUERY)),
        avoid_collisions: store.collisionAware,
        ik_link_name: link,
        pose_stamped: {
          header: { frame_id: kinematics.isMobile ? robot.frame : robot.root },
          pose: poseMessage(pose),
        },
      },
    });
    const outcome = outcomeOf(answer);
    if (outcome.ok) store.setQuery(QUERY, positionsOf(answer.solution));
    else if (store.approximate) {
      store.setQuery(QUERY, nearest(store, robot, kinematics, link, pose));
      store.ikProblem = `approximate: ${outcome.text}`;
    } else store.ikProblem = outcome.text;
  }
}

/** Positions that bring a link as near to a pose as damped least squares gets from where the goal is. */
function nearest(
  store: MotionStore,
  robot: MotionRobot,
  kinematics: Kinematics,
  link: string,
  pose: THREE.Matrix4,
): Positions {
  const followers = new Set(robot.mimics.map((mimic) => mimic.variable));
  const active = new Set(groupOf(robot, store.group)?.active);
  const free = variablesOf(robot, store.group).filter(
    (one) => active.has(one.name) && !followers.has(one.name),
  );
  const q = store.positions(QUERY);
  for (let round = 0; round < ROUNDS; round++) {
    const now = kinematics.pose(link, q);
    if (!now) return q;
    const error = difference(now, pose);
    if (Math.hypot(...error) < NEAR) break;
    const columns = free.map(({ name }) => {
      const moved = kinematics.pose(link, { ...q, [name]: q[name] + STEP }) as THREE.Matrix4;
      return difference(now, moved).map((value) => value / STEP);
    });
    const change = damped(columns, error);
    free.forEach(({ name, lower, upper }, at) => {
      const step = Math.max(-MOST_STEP, Math.min(MOST_STEP, change[at]));
      q[name] = Math.max(lower ?? -Infinity, Math.min(upper ?? Infinity, q[name] + step));
    });
  }
  return q;
}

/** From one pose to another: metres and a rotation vector. */
function difference(from: THREE.Matrix4, to: THREE.Matrix4): number[] {
  const shift = new THREE.Vector3()
    .setFromMatrixPosition(to)
    .sub(new THREE.Vector3().setFromMatrixPosition(from));
  const turn = new THREE.Quaternion()
    .setFromRotationMatrix(to)
    .multiply(new THREE.Quaternion().setFromRotationMatrix(from).invert());
  if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
  const axis = new THREE.Vector3(turn.x, turn.y, turn.z);
  const size = axis.length();
  if (size > 1e-12) axis.multiplyScalar((2 * Math.atan2(size, turn.w)) / size);
  return [...shift.toArray(), ...axis.toArray()];
}

/** `Jᵀ (J Jᵀ + λ² I)⁻¹ e` of a Jacobian's columns. */
function damped(columns: number[][], error: number[]): number[] {
  const size = error.length;
  const matrix = Array.from({ length: size }, (_, row) =>
    Array.from({ length: size + 1 }, (_, column) => {
      if (column === size) return error[row];
      return columns.reduce(
        (sum, one) => sum + one[row] * one[column],
        row === column ? DAMPING ** 2 : 0,
      );
    }),
  );
  for (let at = 0; at < size; at++) {
    const pivot = matrix
      .slice(at)
      .reduce(
        (best, row, index) => (Math.abs(row[at]) > Math.abs(matrix[best][at]) ? at + index : best),
        at,
      );
    [matrix[at], matrix[pivot]] = [matrix[pivot], matrix[at]];
    for (let row = 0; row < size; row++) {
      if (row === at) continue;
      const factor = matrix[row][at] / matrix[at][at];
      for (let column = at; column <= size; column++)
        matrix[row][column] -= factor * matrix[at][column];
    }
  }
  const solved = matrix.map((row, at) => row[size] / row[at]);
  return columns.map((column) => column.reduce((sum, value, row) => sum + value * solved[row], 0));
}
