/** 2D Pose Estimate and 2D Nav Goal: press for the place, drag for the direction. */
import * as THREE from 'three';
import { aim, thinArrow } from '../displays/imu_range_wrench';
import type { JsonObject } from '../json';
import { groundPoint } from '../scene/picking';
import type { RvizTool } from '../generated/messages';
import { takeGoal } from './goal_takers';
import { speaksRos2, stampedHeader, typeFor } from './message_types';
import type { Bench, Tool } from './tool';

interface Goal {
  name: string;
  key: string;
  about: string;
  colour: number;
  /** Returns where it went. */
  publish(bench: Bench, pose: JsonObject): string;
}

const GOAL_TOPICS = ['/move_base_simple/goal', '/goal_pose'] as const;
/** RViz's: half a metre, fifteen degrees. */
const VARIANCES = { x: 0.25, y: 0.25, yaw: 0.06853891909122467 };

/** Tells the localization where the robot is. */
export function poseEstimate(bench: Bench): Tool {
  return arrowTool(bench, {
    name: '2D Pose Estimate',
    key: 'p',
    about: 'Press where the robot is, drag where it looks: /initialpose.',
    colour: 0x3ecf5a,
    publish(to, pose) {
      const told = settings(to, 'SetInitialPose');
      const covariance = new Array<number>(36).fill(0);
      covariance[0] = variance(told, 'X', 'x');
      covariance[7] = variance(told, 'Y', 'y');
      covariance[35] = variance(told, 'Theta', 'yaw');
      return send(to, told?.topic || '/initialpose', 'geometry_msgs/PoseWithCovarianceStamped', {
        pose: { pose, covariance },
      });
    },
  });
}

/** Sends the robot somewhere. */
export function navGoal(bench: Bench): Tool {
  return arrowTool(bench, {
    name: '2D Nav Goal',
    key: 'g',
    about: 'Press where the robot shall go, drag where it shall look: the goal.',
    colour: 0xff2fd0,
    publish(to, pose) {
      const taken = takeGoal({ header: stampedHeader(to.displays.fixedFrame), pose });
      return (
        taken ||
        goalTopics(to)
          .map((topic) => send(to, topic, 'geometry_msgs/PoseStamped', { pose }))
          .join(', ')
      );
    },
  });
}

/** What a `.rviz` file says of a tool. */
function settings(bench: Bench, name: string): RvizTool | undefined {
  return bench.displays.tools.find((tool) => tool.class === name);
}

/** ROS 1's files write deviations, ROS 2's variances. */
function variance(told: RvizTool | undefined, ros1: string, ros2: keyof typeof VARIANCES): number {
  const deviation = Number(told?.properties[`${ros1} std deviation`] ?? NaN);
  const value = Number(told?.properties[`Covariance ${ros2}`] ?? NaN);
  return Number.isFinite(deviation)
    ? deviation * deviation
    : Number.isFinite(value)
      ? value
      : VARIANCES[ros2];
}

/** The file's topic, else those that somebody listens to, else the one of the graph's ROS. */
function goalTopics(bench: Bench): readonly string[] {
  const told = settings(bench, 'SetGoal')?.topic;
  const heard = GOAL_TOPICS.filter((name) => isHeard(bench, name));
  return told ? [told] : heard.length ? heard : [GOAL_TOPICS[speaksRos2(bench.graph) ? 1 : 0]];
}

function isHeard(bench: Bench, name: string): boolean {
  return bench.graph.value.topics.some(
    (topic) => topic.name === name && topic.subscribers.length > 0,
  );
}

/** Publish in the fixed frame; returns what is to be said of it. */
function send(bench: Bench, topic: string, type: string, body: JsonObject): string {
  const message = { header: stampedHeader(bench.displays.fixedFrame), ...body };
  bench.connection
    .call('topic.publish', { topic, type: typeFor(bench.graph, type), message })
    .catch(bench.fail);
  return isHeard(bench, topic) ? topic : `${topic}, to which nobody listens`;
}

function arrowTool(bench: Bench, goal: Goal): Tool {
  const arrow = thinArrow();
  arrow.material.color.setHex(goal.colour);
  arrow.visible = false;
  let from: THREE.Vector3 | null = null;
  let yaw = 0;
  const point = (event: PointerEvent): THREE.Vector3 | null =>
    groundPoint(bench.view, event.clientX, event.clientY);
  const show = (): void => {
    const size = bench.view.metresPerPixel(arrow.position) * 90;
    aim(arrow, new THREE.Vector3(Math.cos(yaw), Math.sin(yaw), 0).multiplyScalar(size), 1);
    bench.view.invalidate(true);
  };
  return {
    name: goal.name,
    key: goal.key,
    about: goal.about,
    cursor: 'crosshair',
    begin() {
      bench.view.hands.add(arrow);
      bench.say(`${goal.name}: press for the place and drag for the direction.`);
    },
    end() {
      from = null;
      arrow.removeFromParent();
      bench.view.invalidate(true);
    },
    down(event) {
      if (event.button !== 0) return false;
      from = point(event);
      yaw = 0;
      if (from) arrow.position.copy(from).setZ(0.02);
      if (from) show();
      return true;
    },
    move(event) {
      if (!from) return false;
      const to = point(event);
      if (to && to.distanceTo(from) > 0.01) yaw = Math.atan2(to.y - from.y, to.x - from.x);
      show();
      return true;
    },
    up() {
      if (!from) return false;
      const position = { x: from.x, y: from.y, z: 0 };
      const where = goal.publish(bench, {
        position,
        orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) },
      });
      const shown = `[${from.x.toFixed(3)}, ${from.y.toFixed(3)}], yaw ${yaw.toFixed(3)}`;
      bench.done();
      bench.say(`${goal.name} in ${bench.displays.fixedFrame}: ${shown} → ${where}`);
      return true;
    },
  };
}
