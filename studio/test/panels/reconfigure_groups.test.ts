import { expect, test } from 'vitest';
import { readGroups, readNodeParameters } from '../../src/panels/reconfigure_groups';

const DESCRIPTOR = {
  description: 'How fast',
  constraints: 'below 2',
  read_only: false,
  range: { from_value: 0, to_value: 2, step: 0.1 },
};

test('parameters of a node are grouped by what is before the first dot', () => {
  const groups = readNodeParameters([
    { name: 'FollowPath.max.vel', type: 'double', value: 1, descriptor: DESCRIPTOR },
    { name: 'use_sim_time', type: 'bool', value: true, descriptor: { ...DESCRIPTOR, range: null } },
    { name: 'FollowPath.on', type: 'bool', value: true, descriptor: DESCRIPTOR },
  ]);
  expect(groups.map(({ name, parameters }) => [name, parameters.map((each) => each.name)])).toEqual(
    [
      ['FollowPath', ['FollowPath.max.vel', 'FollowPath.on']],
      ['', ['use_sim_time']],
    ],
  );
  expect(groups[0].parameters[0]).toMatchObject({
    min: 0,
    max: 2,
    step: 0.1,
    about: 'How fast below 2',
  });
  expect(groups[1].parameters[0].min).toBeUndefined();
});

test('groups without parameters have no tab, and an enum is a choice', () => {
  const row = {
    name: 'mode',
    type: 'int',
    min: null,
    max: 3,
    default: 0,
    value: 1,
    description: '',
  };
  const edit_method = { enum: [{ name: 'Fast', value: 1, description: 'quick' }, 'broken'] };
  const groups = readGroups({
    node: '/n',
    groups: [
      { name: 'empty', parameters: [] },
      { name: 'all', parameters: [{ ...row, edit_method }] },
    ],
  });
  expect(groups.map((group) => group.name)).toEqual(['all']);
  expect(groups[0].parameters[0]).toMatchObject({
    min: undefined,
    max: 3,
    options: [{ name: 'Fast', value: 1, about: 'quick' }],
  });
});
