import { expect, test } from 'vitest';
import type { Connection } from '../../src/connection';
import type { GraphValue, MotionRobot, ServiceRow } from '../../src/generated/messages';
import { MotionStore } from '../../src/motion/store';
import { graphOf } from '../graphs';

const ROBOT = {
  prefix: '/',
  root: 'base',
  defaults: {},
  joints: [],
  groups: [],
  scene: { bodies: [], joints: [] },
} as unknown as MotionRobot;

const WITH: GraphValue = graphOf({
  services: [{ name: '/plan_kinematic_path' } as unknown as ServiceRow],
});
const WITHOUT: GraphValue = graphOf({});

/** A store in use, and the answers that its readings of the robot wait for. */
function storeInUse(): { store: MotionStore; answers: ((robot: MotionRobot) => Promise<void>)[] } {
  const answers: ((robot: MotionRobot) => Promise<void>)[] = [];
  const call = (): Promise<MotionRobot> =>
    new Promise((resolve) => {
      answers.push((robot) => {
        resolve(robot);
        return new Promise((done) => void setTimeout(done));
      });
    });
  const open = (): { close: () => void } => ({ close: () => undefined });
  const store = new MotionStore({ call, open } as unknown as Connection);
  store.use();
  return { store, answers };
}

test('a move_group that the graph told of before its robot was read is missed when it ends', async () => {
  const { store, answers } = storeInUse();
  store.follow(WITH);
  await answers[0]?.(ROBOT);
  expect(answers).toHaveLength(1);
  store.follow(WITHOUT);
  expect(answers).toHaveLength(2);
});

test('one that ends while its robot is read is missed', async () => {
  const { store, answers } = storeInUse();
  store.follow(WITH);
  store.follow(WITHOUT);
  await answers[0]?.(ROBOT);
  expect(answers).toHaveLength(2);
});

test('one that the graph tells of later is missed once, when it ends', async () => {
  const { store, answers } = storeInUse();
  await answers[0]?.(ROBOT);
  store.follow(WITHOUT);
  expect(answers).toHaveLength(1);
  store.follow(WITH);
  store.follow(WITHOUT);
  store.follow(WITHOUT);
  expect(answers).toHaveLength(2);
});
