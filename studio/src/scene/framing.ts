/** From which side a model is looked at when its world is first shown. */
import * as THREE from 'three';

const SIDES = 8;

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
