import * as THREE from 'three';
import { expect, test } from 'vitest';
import {
  arrayMatrix,
  list,
  numbers,
  part,
  poseMatrix,
  seconds,
} from '../../src/displays/message_fields';

test('a part that is not there is empty', () => {
  expect(part({ a: { b: { c: 1 } } }, 'a', 'b')).toEqual({ c: 1 });
  expect(part({ a: 3 }, 'a', 'b')).toEqual({});
  expect(list({ a: 3 }, 'a')).toEqual([]);
});

test('seconds are read by the names of ROS 1 and ROS 2', () => {
  expect(seconds({ sec: 2, nanosec: 500_000_000 })).toBe(2.5);
  expect(seconds({ secs: 2, nsecs: 250_000_000 })).toBe(2.25);
  expect(seconds(null)).toBe(0);
});

test('a quaternion of zeros is no turn, one that is too long is made a unit', () => {
  const position = { x: 1, y: 2, z: 3 };
  const none = poseMatrix({ position, orientation: { x: 0, y: 0, z: 0, w: 0 } });
  expect(none.elements).toEqual(new THREE.Matrix4().setPosition(1, 2, 3).elements);
  const long = poseMatrix({ position, orientation: { x: 0, y: 0, z: 2, w: 2 } });
  const moved = new THREE.Vector3(1, 0, 0).applyMatrix4(long);
  expect(moved.distanceTo(new THREE.Vector3(1, 3, 3))).toBeLessThan(1e-12);
});

test('a pose that nobody knows is no matrix', () => {
  expect(arrayMatrix([null, null, null, null, null, null, null])).toBeNull();
  expect(arrayMatrix([1, 2])).toBeNull();
  expect(arrayMatrix([1, 2, 3, 0, 0, 0, 1])?.elements.slice(12, 15)).toEqual([1, 2, 3]);
});

test('nulls in lists of numbers are NaN', () => {
  expect(numbers([1, null])).toEqual([1, NaN]);
});
