import { expect, test } from 'vitest';
import { Player } from '../../src/motion/player';

function player(): Player {
  const made = new Player();
  made.load({ start: { a: 0 }, times_s: [0, 2, 4], points: [{ a: 0 }, { a: 1 }, { a: 5 }] });
  return made;
}

test('positions lie between the points of the path', () => {
  const made = player();
  const at = [-1, 1, 2, 3, 9].map((time_s) => {
    made.seek(time_s);
    return made.positions()?.a;
  });
  expect(at).toEqual([0, 0.5, 1, 3, 5]);
});

test('at 3x a path is over in a third of its time', () => {
  const made = player();
  expect([made.tick(1000), made.tick(2000), made.time_s]).toEqual([true, true, 3]);
  expect([made.tick(2400), made.time_s]).toEqual([false, 4]);
});

test('a loop begins again, and play does from the end', () => {
  const made = player();
  made.loop = true;
  made.tick(1000);
  made.tick(3000);
  expect([made.playing, made.time_s]).toEqual([true, 2]);
  made.seek(4);
  made.play();
  expect(made.time_s).toBe(0);
});

test('another time for each state keeps the place on the path', () => {
  const made = player();
  made.seek(2);
  expect(made.setDisplayTime('0.1 s')).toBe(true);
  expect(made.duration_s).toBeCloseTo(0.2, 12);
  expect(made.time_s).toBeCloseTo(0.1, 12);
});

test.each(['3x', '0.5', '0.05s', 'realtime', ' 2 X '])('%s is a display time', (word) => {
  expect(player().setDisplayTime(word)).toBe(true);
});

test.each(['', '0 s', '-1x', 'fast', '3 apples', '1.2.3x'])('%s is no display time', (word) => {
  const made = player();
  expect(made.setDisplayTime(word)).toBe(false);
  expect(made.displayTime).toBe('3x');
});

test('a path without points is no path', () => {
  const made = player();
  made.load({ start: {}, times_s: [], points: [] });
  expect([made.path, made.playing, made.positions(), made.duration_s]).toEqual([
    null,
    false,
    null,
    0,
  ]);
});
