import { expect, test, vi } from 'vitest';

vi.mock('../../src/widgets/dom', () => ({ button: null, h: null, notice: null }));
const { asYaml, poseOf, waypointOf } = await import('../../src/navigation/waypoints');

test('a waypoint is its pose and back', () => {
  const waypoint = { frame: 'map', x: 1, y: -2, yaw: 0.5 };
  const back = waypointOf(poseOf(waypoint));
  expect(back).toMatchObject({ frame: 'map', x: 1, y: -2 });
  expect(back.yaw).toBeCloseTo(0.5, 12);
});

test("the file has Nav2's order of orientations", () => {
  expect(asYaml([{ frame: 'map', x: 1, y: 2, yaw: 0 }])).toBe(
    'waypoints:\n  waypoint0:\n    pose: [1, 2, 0]\n    orientation: [1, 0, 0, 0]\n',
  );
});
