/** From where a model is looked at when its world is first shown. */
import * as THREE from 'three';
import type { JointValue, ModelValue } from '../generated/messages';
import type { ViewState } from './cameras';

const SIDES = 8;
/** What part of the picture a model fills. */
const FILLED = 0.78;
const LEAST_DISTANCE_M = 0.08;
const MOST_DISTANCE_M = 60;

/** An eye at a distance from what it looks at, angles as in the view's state. */
export interface Eye {
  distance: number;
  yaw: number;
  pitch: number;
}

/**
 * The yaw nearest to the present one from which no wall hides the middle of what is looked at; the
 * present one where all sides are hidden.
 */
export function freeYaw(
  middle: THREE.Vector3,
  eye: Eye,
  camera: THREE.Camera,
  walls: THREE.Object3D[],
): number {
  const caster = new THREE.Raycaster();
  caster.far = eye.distance;
  caster.camera = camera;
  // Nothing may have been drawn yet.
  for (const wall of walls) wall.updateWorldMatrix(true, true);
  for (let side = 0; side < SIDES; side++) {
    const turn = Math.ceil(side / 2) * ((2 * Math.PI) / SIDES) * (side % 2 ? 1 : -1);
    const yaw = eye.yaw + turn;
    const level = Math.cos(eye.pitch);
    caster.ray.set(
      middle,
      new THREE.Vector3(level * Math.cos(yaw), level * Math.sin(yaw), Math.sin(eye.pitch)),
    );
    if (!caster.intersectObjects(walls, true).length) return yaw;
  }
  return eye.yaw;
}

/** What is looked at first in a world. */
export interface Subjects {
  models: readonly ModelValue[];
  /** Robots, not things that merely can move. */
  areRobots: boolean;
}

const MOST_THINGS = 12;

/** The robots of a world: what has joints that move, or senses; else what can move at all. */
export function subjectsOf(models: readonly ModelValue[], joints: readonly JointValue[]): Subjects {
  const loose = models.filter((model) => !model.static);
  const moves = (index: number): boolean =>
    joints[index] !== undefined && joints[index].type !== 'fixed';
  const robots = loose.filter((model) => model.joints.some(moves));
  return robots.length > 0
    ? { models: robots, areRobots: true }
    : { models: loose.slice(0, MOST_THINGS), areRobots: false };
}

/** The state in which a box fills the picture of a perspective view; null for an empty box. */
export function frameBox(
  box: THREE.Box3,
  eye: Pick<ViewState, 'yaw' | 'pitch'>,
  fov_deg: number,
  aspect: number,
): Pick<ViewState, 'focal' | 'distance'> | null {
  if (box.isEmpty()) return null;
  const centre = box.getCenter(new THREE.Vector3());
  const half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
  const { yaw, pitch } = eye;
  const level = Math.cos(pitch);
  const back = new THREE.Vector3(level * Math.cos(yaw), level * Math.sin(yaw), Math.sin(pitch));
  const right = new THREE.Vector3(-Math.sin(yaw), Math.cos(yaw), 0);
  const up = new THREE.Vector3().crossVectors(back, right);
  const high = Math.tan((fov_deg * Math.PI) / 360) * FILLED;
  let distance = LEAST_DISTANCE_M;
  for (const corner of corners(half)) {
    const across = Math.abs(corner.dot(right)) / (high * aspect);
    const along = Math.abs(corner.dot(up)) / high;
    distance = Math.max(distance, corner.dot(back) + Math.max(across, along));
  }
  return {
    focal: [centre.x, centre.y, centre.z],
    distance: Math.min(distance, MOST_DISTANCE_M),
  };
}

function corners(half: THREE.Vector3): THREE.Vector3[] {
  const signs = [-1, 1];
  return signs.flatMap((x) =>
    signs.flatMap((y) => signs.map((z) => half.clone().multiply(new THREE.Vector3(x, y, z)))),
  );
}
