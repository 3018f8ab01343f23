/** Fields of messages as the displays need them: ROS 2's names, read with care. */
import * as THREE from 'three';
import type { Duration, Pose, Time, Vector3 } from '../generated/messages';
import { isObject, type Json, type JsonObject } from '../json';

/** The object under a path of names; empty where there is none. */
export function part(value: Json | undefined, ...names: string[]): JsonObject {
  let at: Json | undefined = value;
  for (const name of names) at = isObject(at) ? at[name] : undefined;
  return isObject(at) ? at : {};
}

/** A list under a name. */
export function list<T>(value: JsonObject, name: string): T[] {
  const found = value[name];
  return Array.isArray(found) ? (found as unknown as T[]) : [];
}

/** A vector of three fields. */
export function vector(value: Vector3 | Json | undefined): THREE.Vector3 {
  const { x, y, z } = part(value as Json) as unknown as Partial<Vector3>;
  return new THREE.Vector3(x ?? 0, y ?? 0, z ?? 0);
}

/** A `geometry_msgs/Pose` as a matrix; a quaternion of zeros counts as no turn, as in RViz. */
export function poseMatrix(value: Pose | Json | undefined): THREE.Matrix4 {
  const {
    x = 0,
    y = 0,
    z = 0,
    w = 1,
  } = part(value as Json, 'orientation') as unknown as Partial<Pose['orientation']>;
  const turn = new THREE.Quaternion(x, y, z, w);
  if (turn.lengthSq() < 1e-12) turn.set(0, 0, 0, 1);
  return new THREE.Matrix4().compose(vector(part(value as Json).position), turn.normalize(), ONE);
}

const ONE = new THREE.Vector3(1, 1, 1);

/** The matrix of a pose of seven numbers; null for null. */
export function arrayMatrix(value: Json | undefined): THREE.Matrix4 | null {
  if (!Array.isArray(value) || value.length < 7 || value[0] === null) return null;
  const [x, y, z, qx, qy, qz, qw] = value as number[];
  return new THREE.Matrix4().compose(
    new THREE.Vector3(x, y, z),
    new THREE.Quaternion(qx, qy, qz, qw),
    ONE,
  );
}

/** Seconds of a duration or stamp, by ROS 1's or ROS 2's names. */
export function seconds(value: Duration | Time | Json | undefined): number {
  const { sec, secs, nanosec, nsecs } = part(value as Json) as Record<string, number>;
  return (sec ?? secs ?? 0) + (nanosec ?? nsecs ?? 0) * 1e-9;
}

/** Numbers of a list that may hold nulls for NaN. */
export function numbers(value: Json | undefined): number[] {
  return Array.isArray(value) ? value.map((each) => (typeof each === 'number' ? each : NaN)) : [];
}
