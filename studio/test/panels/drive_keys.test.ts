import { expect, test } from 'vitest';
import { directionOf } from '../../src/panels/drive_keys';

function pressed(...keys: string[]): ReturnType<typeof directionOf> {
  return directionOf(new Map(keys.map((key) => [key, false])));
}

test('keys add up, and no part is more than one', () => {
  expect(pressed('w', 'a')).toEqual({ x: 1, y: 0, z: 0, turn: 1 });
  expect(pressed('w', 'arrowup', 'i')).toMatchObject({ x: 1 });
  expect(pressed('w', 's')).toMatchObject({ x: 0 });
});

test('with Shift the same keys go sideways', () => {
  expect(directionOf(new Map([['j', true]]))).toEqual({ x: 0, y: 1, z: 0, turn: 0 });
});

test('a key that does nothing moves nothing', () => {
  expect(pressed('?')).toEqual({ x: 0, y: 0, z: 0, turn: 0 });
});
