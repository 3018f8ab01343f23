import { expect, test, vi } from 'vitest';
import type { ChannelHandlers } from '../../src/channel';
import type { Connection } from '../../src/connection';
import { Frames } from '../../src/scene/frames';

/** Frames of which a stream has told: map and, without a way to it, lost. */
function frames(): Frames {
  let handlers: ChannelHandlers = {};
  const open = (_: string, __: unknown, given: ChannelHandlers): object => {
    handlers = given;
    return {};
  };
  const made = new Frames({ open } as unknown as Connection);
  made.setFixed('map');
  const buffer = new Float32Array([1, 2, 3, 0, 0, 0, 1, ...Array<number>(7).fill(NaN)]).buffer;
  void handlers.onData?.({ frames: [{ name: 'base_link' }, { name: 'lost' }] } as never);
  void handlers.onFrame?.({ channel: 1, kind: 0, count: 2, stamp_s: 0, buffer, offset: 0 });
  return made;
}

test('frames are found with and without a slash before them', () => {
  expect([frames().at('base_link'), frames().at('/base_link')]).toEqual([0, 0]);
});

test('there is no pose of a frame without a way to it, nor of one nobody told of', () => {
  expect([frames().at('lost'), frames().at('elsewhere')]).toEqual([-1, -1]);
});

test('tf has time to come up before what is missing is missing', () => {
  vi.useFakeTimers();
  const made = frames();
  let told = 0;
  made.onRenamed(() => {
    told += 1;
  });
  expect(made.settled).toBe(false);
  vi.advanceTimersByTime(3000);
  expect([made.settled, told]).toEqual([true, 1]);
  vi.useRealTimers();
});

test('the fixed frame needs no tf', () => {
  const made = frames();
  const at = made.at('/map');
  expect([...made.poses.subarray(at, at + 7)]).toEqual([0, 0, 0, 0, 0, 0, 1]);
});
