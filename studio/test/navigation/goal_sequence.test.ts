import { expect, test } from 'vitest';
import type { ChannelHandlers } from '../../src/channel';
import type { Connection } from '../../src/connection';
import type { Json, JsonObject } from '../../src/json';
import { Trip, type Standing } from '../../src/navigation/goal_sequence';

const POINTS = [1, 2, 3].map((x) => ({ frame: 'map', x, y: 0, yaw: 0 }));

/** A trip with a server that a test speaks for. */
function trip(type: string, options: { atOnce: boolean; loops: number }) {
  const goals: JsonObject[] = [];
  let handlers: ChannelHandlers = {};
  let standing: Standing | undefined;
  const open = (_: string, params: JsonObject, given: ChannelHandlers): { close(): void } => {
    goals.push(params.goal as JsonObject);
    handlers = given;
    return { close: () => undefined };
  };
  const made = new Trip(
    { open } as unknown as Connection,
    { name: '/go', type },
    POINTS,
    options,
    (news) => {
      standing = news;
    },
  );
  const say = (state: string, feedback: Json = null, result: Json = null): void =>
    void handlers.onData?.({ state, text: '', feedback, result });
  return { made, goals, say, standing: () => standing as Standing };
}

test('waypoints one after the other go on past one that is missed', () => {
  const { goals, say, standing } = trip('move_base_msgs/MoveBase', { atOnce: false, loops: 0 });
  say('succeeded');
  say('aborted');
  expect(standing().marks).toEqual(['reached', 'missed', 'driving']);
  say('succeeded');
  expect(goals.length).toBe(3);
  expect(standing()).toMatchObject({
    over: true,
    state: 'finished',
    text: '1 of 3 waypoints were missed',
  });
});

test('loops begin again with the first waypoint', () => {
  const { goals, say, standing } = trip('move_base_msgs/MoveBase', { atOnce: false, loops: 1 });
  for (let round = 0; round < 3; round++) say('succeeded');
  expect(standing().marks).toEqual(['driving', '', '']);
  for (let round = 0; round < 3; round++) say('succeeded');
  expect(goals.length).toBe(6);
  expect(standing()).toMatchObject({ over: true, state: 'succeeded' });
});

test('waypoints as one action are marked by its feedback and result', () => {
  const { goals, say, standing } = trip('nav2_msgs/action/FollowWaypoints', {
    atOnce: true,
    loops: 0,
  });
  say('executing', { current_waypoint: 1 });
  expect(standing().marks).toEqual(['reached', 'driving', '']);
  say('succeeded', null, { missed_waypoints: [1] });
  expect(goals.length).toBe(1);
  expect(standing().marks).toEqual(['reached', 'missed', 'reached']);
});

test('a cancelled trip is over, whatever comes afterwards', () => {
  const { made, say, standing } = trip('nav2_msgs/action/FollowWaypoints', {
    atOnce: true,
    loops: 0,
  });
  made.cancel();
  say('succeeded');
  expect(standing()).toMatchObject({ over: true, state: 'cancelled' });
});
