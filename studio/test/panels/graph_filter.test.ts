import { expect, test } from 'vitest';
import { drawingOf, FIRST_CHOICE, type GraphChoice } from '../../src/panels/graph_filter';
import { graphOf, nodeRow, topicRow } from '../graphs';

const GRAPH = graphOf({
  nodes: ['/robot', '/planner', '/lonely', '/rviz'].map(nodeRow),
  topics: [
    topicRow('/odom', { publishers: ['/robot'], subscribers: ['/planner', '/rviz'] }),
    topicRow('/cmd_vel', { publishers: ['/planner'], subscribers: ['/robot'] }),
    topicRow('/tf', { publishers: ['/robot'], subscribers: ['/planner'] }),
    topicRow('/unheard', { publishers: ['/robot'] }),
    topicRow('/camera', {
      type: 'sensor_msgs/msg/Image',
      publishers: ['/robot'],
      subscribers: ['/planner'],
    }),
    topicRow('/parameter_events', { publishers: ['/robot'], subscribers: ['/planner'] }),
    topicRow('/secret', { publishers: ['/robot'], subscribers: ['/planner'], hidden: true }),
  ],
});

function drawn(choice: Partial<GraphChoice>): { boxes: string[]; ties: string[] } {
  const { nodes, edges } = drawingOf(GRAPH, { ...FIRST_CHOICE, ...choice });
  return {
    boxes: nodes.map((node) => node.id),
    ties: edges.map((edge) => `${edge.from} ${edge.to} ${edge.label ?? ''}`.trim()),
  };
}

test('at first there are nodes with their topics as labels, without debug, tf and parameters', () => {
  expect(drawn({})).toEqual({
    boxes: ['n:/robot', 'n:/planner', 'n:/lonely'],
    ties: ['n:/robot n:/planner /odom\n/camera', 'n:/planner n:/robot /cmd_vel'],
  });
});

test('many topics of one tie are counted', () => {
  const { ties } = drawn({ tf: false, params: false });
  expect(ties[0]).toBe('n:/robot n:/planner 4 topics');
});

test('nodes without ties are hidden on demand', () => {
  expect(drawn({ unreachable: true }).boxes).not.toContain('n:/lonely');
});

test('images are hidden by their type', () => {
  expect(drawn({ images: true }).ties[0]).toBe('n:/robot n:/planner /odom');
});

test('names are wanted by a part of them, or kept away by a minus', () => {
  expect(drawn({ nodes: 'robot, lone' }).boxes).toEqual(['n:/robot', 'n:/lonely']);
  expect(drawn({ nodes: '-lone' }).boxes).toEqual(['n:/robot', 'n:/planner']);
  expect(drawn({ nodes: '/' }).boxes.length).toBe(3);
});

test('of topics as boxes dead sinks and leaves are hidden until asked for', () => {
  const all = { mode: 'all', images: true, debug: false } as const;
  expect(drawn(all).boxes).not.toContain('t:/unheard');
  expect(drawn({ ...all, deadSinks: false, leafTopics: false }).boxes).toContain('t:/unheard');
  expect(
    drawn({ ...all, mode: 'active', deadSinks: false, leafTopics: false }).boxes,
  ).not.toContain('t:/unheard');
});

test('what is hidden in ROS is never drawn', () => {
  const choice = { mode: 'all', debug: false, deadSinks: false, leafTopics: false } as const;
  expect(drawn(choice).boxes).not.toContain('t:/secret');
});
