import { expect, test } from 'vitest';
import { Motion } from '../../src/replay/motion';
import { Topic } from '../../src/replay/table';
import { lastBefore, Recording, type Head, type Integers } from '../../src/replay/unpacking';

/** Whole numbers as Python packs them: columns of differences, zigzag, seven bits each. */
function packed(rows: number[][], order: number): number[] {
  const found: number[] = [];
  for (let column = 0; column < (rows[0]?.length ?? 0); column++) {
    let values = rows.map((row) => row[column]);
    for (let i = 0; i < order; i++)
      values = values.map((value, j) => value - (j ? values[j - 1] : 0));
    for (const value of values) {
      let rest = value < 0 ? -2 * value - 1 : 2 * value;
      while (rest >= 128) {
        found.push((rest % 128) + 128);
        rest = Math.floor(rest / 128);
      }
      found.push(rest);
    }
  }
  return found;
}

/** A recording with arrays, and a head that is given where they are. */
function recording(
  arrays: [number[][], number][],
  head: (places: Integers[]) => object,
): Recording {
  const data: number[] = [];
  const places = arrays.map(([rows, order]): Integers => {
    const bytes = packed(rows, order);
    data.push(...bytes);
    return [data.length - bytes.length, bytes.length, rows.length, rows[0].length, order];
  });
  const text = new TextEncoder().encode(JSON.stringify(head(places)));
  const buffer = new ArrayBuffer(4 + text.length + data.length);
  new DataView(buffer).setUint32(0, text.length, true);
  new Uint8Array(buffer, 4).set(text);
  new Uint8Array(buffer, 4 + text.length).set(data);
  return new Recording(buffer);
}

test('whole numbers come back, also large and negative ones', () => {
  const rows = [
    [0, 5],
    [-3, 2 ** 40],
    [2 ** 31, -(2 ** 40)],
    [7, 7],
  ];
  for (const order of [1, 2]) {
    const made = recording([[rows, order]], () => ({}));
    const place: Integers = [0, 99, 4, 2, order];
    expect([...made.integers(place)]).toEqual(rows.flat());
  }
});

test('poses between two frames are in proportion, and the last frame may be shorter', () => {
  const places = [
    [0, 0, 0],
    [100, 0, 0],
    [150, 0, 0],
  ];
  const turns = places.map(() => [0, 0, 0, 1000]);
  const made = recording(
    [
      [places, 2],
      [turns, 2],
    ],
    ([first, second]) =>
      ({
        tracks: [{ places: first, turns: second, steps: [0.01, 0.001], there: [[0, 2]] }],
        frames: { count: 3, period_s: 0.04, start_s: 5, duration_s: 0.06 },
      }) satisfies Partial<Head>,
  );
  const motion = new Motion(made);
  motion.look(0.02);
  expect(motion.poses[0]).toBeCloseTo(0.5);
  expect(motion.there).toEqual([true]);
  motion.look(0.05);
  expect(motion.poses[0]).toBeCloseTo(1.25);
  motion.look(9);
  expect(motion.poses[0]).toBeCloseTo(1.5);
  expect(motion.there).toEqual([false]);
});

test('topics tell their last value, and joints by name', () => {
  const made = recording(
    [
      [[[0], [500000]].map(([t]) => [t]), 2],
      [[[0], [4]], 1],
    ],
    () => ({}),
  );
  const topic = new Topic(made, {
    name: '/joint_states',
    type: 'sensor_msgs/JointState',
    count: 2,
    times: [0, 9, 2, 1, 2],
    columns: [
      { name: 'name.0', text: 'elbow' },
      {
        name: 'position.0',
        low: 1,
        step: 0.5,
        at: [packed([[0], [500000]], 2).length, 9, 2, 1, 1],
      },
    ],
  });
  expect(topic.columns[1].name).toBe('position.0 (elbow)');
  expect([topic.rowAt(-0.1), topic.rowAt(0.49), topic.rowAt(0.5)]).toEqual([-1, 0, 1]);
  expect(topic.columns[1].text(1)).toBe('3');
  expect(topic.columns[1].text(-1)).toBe('');
});

test('the last place before a value', () => {
  expect([lastBefore([1, 2, 2, 5], 0), lastBefore([1, 2, 2, 5], 2), lastBefore([], 1)]).toEqual([
    -1, 2, -1,
  ]);
});
