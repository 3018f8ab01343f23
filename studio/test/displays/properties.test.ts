import { expect, test } from 'vitest';
import { colour, flag, num, Properties, text } from '../../src/displays/properties';

function properties(): Properties {
  return new Properties([
    text('Topic', '', 'Where from.', { server: true }),
    num('Size (m)', 0.01, 'How large.'),
    flag('Covariance', true, 'Whether.'),
    num('Covariance/Alpha', 0.3, 'How opaque.'),
    colour('Color', '255; 0; 51', 'Its colour.'),
  ]);
}

test('a layout keeps only what differs from the defaults', () => {
  const props = properties();
  expect(props.toObject()).toEqual({});
  props.set('Size (m)', 0.5);
  expect(props.toObject()).toEqual({ 'Size (m)': 0.5 });
});

test('nested values of a .rviz file are found by their paths', () => {
  const props = properties();
  props.fromObject({ Topic: { Value: '/scan' }, Covariance: { Alpha: 0.9, Value: false } });
  expect([props.text('Topic'), props.num('Covariance/Alpha'), props.flag('Covariance')]).toEqual([
    '/scan',
    0.9,
    false,
  ]);
  expect(props.forServer()).toEqual({ Topic: '/scan' });
});

test('a value that comes before its property is kept for it', () => {
  const props = properties();
  props.fromObject({ Namespaces: { walls: false } });
  expect(props.add(flag('Namespaces/walls', true, 'A namespace.'))).toBe(true);
  expect(props.flag('Namespaces/walls')).toBe(false);
  expect(props.add(flag('Namespaces/walls', true, 'A namespace.'))).toBe(false);
});

test('texts of files become numbers, switches and colours', () => {
  const props = properties();
  props.fromObject({ 'Size (m)': '2.5', Covariance: 'true' });
  expect([props.num('Size (m)'), props.flag('Covariance')]).toEqual([2.5, true]);
  props.set('Size (m)', 'much');
  expect(props.num('Size (m)')).toBe(0);
  expect(props.colour('Color')).toEqual([1, 0, 0.2]);
});
