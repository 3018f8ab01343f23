import { expect, test } from 'vitest';
import { asYaml, leafText, messageRows } from '../../src/widgets/message_rows';

const MESSAGE = { header: { frame_id: 'odom' }, position: [0.5, null], ok: true, none: [] };

test('rows are those of the message alone until one is opened', () => {
  const rows = messageRows(MESSAGE, '/state', 0, new Set());
  expect(rows.map((row) => [row.path, row.value, row.branch])).toEqual([
    ['/state/header', '', true],
    ['/state/position', '2 items: [0.5, nan]', true],
    ['/state/ok', 'True', false],
    ['/state/none', '[]', false],
  ]);
});

test('an opened list has rows whose paths a plot understands', () => {
  const rows = messageRows(MESSAGE, '/state', 0, new Set(['/state/position']));
  const items = rows.filter((row) => row.depth === 1);
  expect(items.map((row) => row.path)).toEqual(['/state/position[0]', '/state/position[1]']);
  expect(items.map((row) => row.numeric)).toEqual([true, false]);
});

test('an array that the server has cut says its true length', () => {
  const [row] = messageRows({ data: { '…': 640, head: [1, 2] } }, '/image', 0, new Set());
  expect(row.value).toBe('640 items: [1, 2]');
});

test('of a long list the first eight are previewed and 200 have rows', () => {
  const ranges = Array.from({ length: 300 }, (_, index) => index);
  const rows = messageRows({ ranges }, '/scan', 0, new Set(['/scan/ranges']));
  expect(rows[0].value).toBe('300 items: [0, 1, 2, 3, 4, 5, 6, 7, …]');
  expect(rows.length).toBe(201);
});

test('a message as text is indented as YAML is', () => {
  expect(asYaml({ pose: { x: 1 }, names: ['a', 'b'], ok: false })).toBe(
    'pose:\n  x: 1\nnames:\n  - "a"\n  - "b"\nok: False',
  );
  expect(leafText({})).toBe('{}');
});
