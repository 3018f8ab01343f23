import { expect, test } from 'vitest';
import type { GraphStore } from '../../src/graph_store';
import { missed, order, progress, robots, server } from '../../src/navigation/drivers';
import { graphOf } from '../graphs';

function store(...rows: [name: string, type: string, servers: string[]][]): GraphStore {
  const actions = rows.map(([name, type, servers]) => ({ name, type, servers, clients: [] }));
  return { value: graphOf({ actions }) } as unknown as GraphStore;
}

const GRAPH = store(
  ['/b/navigate_to_pose', 'nav2_msgs/action/NavigateToPose', ['/b/bt_navigator']],
  ['/a/move_base', 'move_base_msgs/MoveBase', ['/a/move_base']],
  ['/c/move_base', 'move_base_msgs/MoveBase', []],
  ['/b/follow_waypoints', 'nav2_msgs/action/FollowWaypoints', ['/b/waypoint_follower']],
);

test('robots are the namespaces of servers that are there', () => {
  expect(robots(GRAPH)).toEqual(['/a', '/b']);
});

test('a mode has a server of the robot itself or none', () => {
  expect(server(GRAPH, '/b', 'follow')?.name).toBe('/b/follow_waypoints');
  expect(server(GRAPH, '/a', 'follow')).toBeUndefined();
  expect(server(GRAPH, '/c', 'goal')).toBeUndefined();
});

test('a goal is the message of its action', () => {
  const poses = [{ name: 1 }, { name: 2 }];
  const goalFor = (type: string) => order({ name: '/x', type }, poses, 3).goal;
  expect(goalFor('move_base_msgs/MoveBase')).toEqual({ target_pose: poses[0] });
  expect(goalFor('nav2_msgs/action/NavigateToPose')).toEqual({ pose: poses[0] });
  expect(goalFor('nav2_msgs/action/FollowWaypoints')).toEqual({ poses, number_of_loops: 3 });
});

test('feedback of Nav2 and of move_base is read in one form', () => {
  const pose = { pose: { position: { x: 1, y: 2, z: 0 } } };
  expect(progress({ base_position: pose }).position).toMatchObject({ x: 1, y: 2 });
  expect(
    progress({
      distance_remaining: 3.5,
      number_of_recoveries: 1,
      estimated_time_remaining: { sec: 4, nanosec: 0 },
    }),
  ).toEqual({ distance_m: 3.5, recoveries: 1, eta_s: 4 });
});

test('missed waypoints are numbers or rows with a number', () => {
  expect(missed({ missed_waypoints: [1, { index: 4 }] })).toEqual([1, 4]);
});
