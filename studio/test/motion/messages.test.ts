import { expect, test } from 'vitest';
import { jointGoal, outcomeOf, pathOf } from '../../src/motion/messages';

test('an outcome says the name of its code, and why', () => {
  expect(outcomeOf({ error_code: { val: 1 } })).toEqual({ ok: true, text: 'SUCCESS (1)', why: '' });
  expect(outcomeOf({ error_code: { val: -12, message: 'link a touches box' } }).text).toBe(
    'GOAL_IN_COLLISION (-12): link a touches box',
  );
  expect(outcomeOf({ error_code: { val: -99 } }).text).toBe('unknown code (-99)');
  expect(outcomeOf(null).ok).toBe(false);
});

test('paths follow one another in time and keep joints that they do not move', () => {
  const trajectory = (name: string, ...rows: [number, number][]) => ({
    joint_trajectory: {
      joint_names: [name],
      points: rows.map(([sec, position]) => ({
        positions: [position],
        time_from_start: { sec, nanosec: 0 },
      })),
    },
  });
  const path = pathOf([trajectory('a', [0, 1], [2, 3]), trajectory('b', [1, 7])], {
    joint_state: { name: ['a', 'b'], position: [0, 5] },
  });
  expect(path.times_s).toEqual([0, 2, 3]);
  expect(path.points).toEqual([
    { a: 1, b: 5 },
    { a: 3, b: 5 },
    { a: 3, b: 7 },
  ]);
});

test('a goal for joints has every variable, 0 where it is not set', () => {
  const { joint_constraints } = jointGoal({ a: 0.5 }, ['a', 'b']);
  expect(joint_constraints).toMatchObject([
    { joint_name: 'a', position: 0.5 },
    { joint_name: 'b', position: 0 },
  ]);
});
