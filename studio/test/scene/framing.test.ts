import * as THREE from 'three';
import { expect, test } from 'vitest';
import type { JointValue, ModelValue } from '../../src/generated/messages';
import { frameBox, subjectsOf } from '../../src/scene/framing';

const EYE = { yaw: -0.9, pitch: 0.5 };
const FOV_DEG = 50;

/** How much of the picture the box fills, across and along, from where `frameBox` says. */
function filled(box: THREE.Box3, aspect: number): number {
  const state = frameBox(box, EYE, FOV_DEG, aspect);
  if (!state) throw new Error('the box is empty');
  const camera = new THREE.PerspectiveCamera(FOV_DEG, aspect, 0.001, 1000);
  camera.up.set(0, 0, 1);
  const { yaw, pitch } = EYE;
  const level = Math.cos(pitch);
  const back = new THREE.Vector3(level * Math.cos(yaw), level * Math.sin(yaw), Math.sin(pitch));
  const focal = new THREE.Vector3(...state.focal);
  camera.position.copy(focal).addScaledVector(back, state.distance);
  camera.lookAt(focal);
  camera.updateMatrixWorld();
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(
    (at) =>
      new THREE.Vector3(
        (at & 1 ? box.max : box.min).x,
        (at & 2 ? box.max : box.min).y,
        (at & 4 ? box.max : box.min).z,
      ),
  );
  return Math.max(
    ...corners.map((corner) => {
      const at = corner.project(camera);
      return Math.max(Math.abs(at.x), Math.abs(at.y));
    }),
  );
}

test.each([
  ['a flat robot in a wide view', [1, 0.6, 0.2], 1.8],
  ['a tall one', [0.3, 0.3, 2], 1.8],
  ['a small one in a narrow view', [0.06, 0.04, 0.05], 0.5],
] as const)('%s fills most of the picture and stays within it', (_, size, aspect) => {
  const half = new THREE.Vector3(...size).multiplyScalar(0.5);
  const box = new THREE.Box3(half.clone().negate(), half).translate(new THREE.Vector3(3, -2, 1));
  const part = filled(box, aspect);
  expect(part).toBeGreaterThan(0.6);
  expect(part).toBeLessThanOrEqual(0.79);
});

test('nothing is framed where there is nothing', () => {
  expect(frameBox(new THREE.Box3(), EYE, FOV_DEG, 1)).toBeNull();
});

function model(name: string, isStatic: boolean, joints: number[] = []): ModelValue {
  return { name, static: isStatic, joints, bodies: [] } as unknown as ModelValue;
}

test('robots are looked at before things, and things before what never moves', () => {
  const joints = [{ type: 'fixed' }, { type: 'revolute' }] as unknown as JointValue[];
  const ground = model('ground', true);
  const ball = model('ball', false);
  const camera = model('camera', false, [0]);
  const robot = model('robot', false, [0, 1]);
  expect(subjectsOf([ground, ball, camera, robot], joints)).toEqual({
    models: [robot],
    areRobots: true,
  });
  expect(subjectsOf([ground, ball], joints)).toEqual({ models: [ball], areRobots: false });
  expect(subjectsOf([ground], joints).models).toEqual([]);
});
