import { expect, test } from 'vitest';
import { readScene, writeScene } from '../../src/motion/scene_file';

const POSE = { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const OBJECT = {
  id: 'the table',
  header: { frame_id: 'world' },
  pose: POSE,
  operation: 0,
  primitives: [
    { type: 1, dimensions: [1, 2, 3] },
    { type: 3, dimensions: [0.5, 0.1] },
  ],
  primitive_poses: [POSE, POSE],
  meshes: [
    {
      vertices: [
        { x: 0, y: 0, z: 0 },
        { x: 1, y: 0, z: 0 },
        { x: 0, y: 1, z: 0 },
      ],
      triangles: [{ vertex_indices: [0, 1, 2] }],
    },
  ],
  mesh_poses: [POSE],
};

test('what was written is read again', () => {
  expect(readScene(writeScene('noname', [OBJECT]), 'world', 'a.scene')).toEqual([OBJECT]);
});

test("a cylinder's radius comes first in the file, its height in the message", () => {
  expect(writeScene('noname', [OBJECT])).toContain('\ncylinder\n0.1 0.5\n');
});

test('a file of the older form has shapes right behind the name', () => {
  const text = 'noname\n* ball\n1\nsphere\n0.3\n0 0 1\n0 0 0 1\n0 0 0 0\n.\n';
  const [ball] = readScene(text, 'base', 'old.scene');
  expect(ball).toMatchObject({
    id: 'ball',
    header: { frame_id: 'base' },
    primitives: [{ type: 2, dimensions: [0.3] }],
  });
});

test.each([
  [
    'noname\n* a\n1\ntorus\n',
    "old.scene:4: there is no shape 'torus'; there are box, sphere, cylinder, cone, mesh",
  ],
  [
    'noname\n* a\n1\nsphere\nbig\n',
    "old.scene:5: 'big' is no number; a size of the sphere should be here",
  ],
  ['noname\n* a\n1\n', 'old.scene ends where the kind of a shape should be'],
  ['noname\nbox\n', "old.scene:2: 'box' where '*' before an object or '.' at the end should be"],
])('a wrong file is refused with its line: %j', (text, problem) => {
  expect(() => readScene(text, 'base', 'old.scene')).toThrow(problem);
});
