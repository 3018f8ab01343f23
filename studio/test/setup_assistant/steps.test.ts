import { expect, test } from 'vitest';
import type { AssistantValue } from '../../src/generated/messages';
import { counted } from '../../src/setup_assistant/collisions_step';
import { linksOf } from '../../src/setup_assistant/groups_step';

const link = (name: string, parent: string, kind = 'revolute') => ({
  name,
  parent,
  joint: parent ? `${parent}_${name}` : '',
  kind,
  is_solid: true,
});
const group = (name: string, part: object) => ({
  name,
  chains: [],
  links: [],
  joints: [],
  subgroups: [],
  solver: '',
  ...part,
});
const arm = group('arm', { chains: [{ base_link: 'a', tip_link: 'c' }] });
const hand = group('hand', { links: ['c'], joints: ['c_d'] });
const both = group('both', { subgroups: ['arm', 'hand'] });
const value = {
  links: [link('a', ''), link('b', 'a'), link('c', 'b'), link('d', 'c', 'prismatic')],
  groups: [arm, hand, both],
} as unknown as AssistantValue;

test('the links of a group are those that its joints carry, subgroups included', () => {
  expect(linksOf(arm, value).sort()).toEqual(['b', 'c']);
  expect(linksOf(hand, value).sort()).toEqual(['c', 'd']);
  expect(linksOf(both, value).sort()).toEqual(['b', 'c', 'd']);
});

test('pairs are counted by reason', () => {
  const pair = (reason: string) => ({ link1: 'a', link2: 'b', reason });
  expect(counted([pair('Adjacent'), pair(''), pair('Never'), pair('Never')])).toBe(
    '3 of 4 pairs are not checked: 1 Adjacent, 2 Never.',
  );
  expect(counted([pair('')])).toBe('0 of 1 pairs are not checked.');
});
