/** Where the robot stands in the fixed frame. */
import type * as THREE from 'three';
import { arrayMatrix } from '../displays/message_fields';
import type { Frames } from '../scene/frames';
import type { MotionStore } from './store';

/**
 * The pose, in the fixed frame, of the frame that `Kinematics.poses` are in. The root of tf's tree
 * has no transform of its own: then the first link that has one tells.
 */
export function standing(frames: Frames, store: MotionStore): THREE.Matrix4 | null {
  const { robot, kinematics } = store;
  if (!robot || !kinematics) return null;
  const own = poseOfFrame(frames, kinematics.isMobile ? robot.frame : robot.root);
  if (own) return own;
  const poses = kinematics.poses(store.current);
  for (const [at, body] of robot.scene.bodies.entries()) {
    const found = poseOfFrame(frames, body.link);
    if (found) return found.multiply(poses[at].clone().invert());
  }
  return null;
}

/** Where a frame of tf is; null when there is no way to it. */
export function poseOfFrame(frames: Frames, name: string): THREE.Matrix4 | null {
  const at = frames.at(name);
  return at < 0 ? null : arrayMatrix([...frames.poses.slice(at, at + 7)]);
}
