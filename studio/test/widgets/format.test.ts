import { expect, test } from 'vitest';
import { bandwidth, clock, csvField, rate, short } from '../../src/widgets/format';

test.each([
  [0.1 + 0.2, '0.3'],
  [1.3e-7, '1.3e-7'],
  [12, '12'],
  [123456789, '123456789'],
  [1234567.89, '1234570'],
  [NaN, 'NaN'],
  [-Infinity, '-inf'],
])('%d is short', (value, text) => {
  expect(short(value)).toBe(text);
});

test('bytes per second have the unit that fits', () => {
  expect([12, 1500, 2_345_678, null].map(bandwidth)).toEqual([
    '12 B/s',
    '1.5 kB/s',
    '2.35 MB/s',
    '',
  ]);
});

test('a rate is whole from a hundred hertz on', () => {
  expect([29.987, 100.4, Infinity, undefined].map(rate)).toEqual(['29.99', '100', '', '']);
});

test.each([
  [0, '00:00:00.000'],
  [3723.25, '01:02:03.250'],
  [-1.5, '-00:00:01.500'],
  [NaN, '–'],
])('%d seconds are a clock', (seconds, text) => {
  expect(clock(seconds)).toBe(text);
});

test('a clock that rounds up carries into seconds, minutes and hours', () => {
  expect([0.9997, 59.9996, 3599.9999].map(clock)).toEqual([
    '00:00:01.000',
    '00:01:00.000',
    '01:00:00.000',
  ]);
});

test('a field of CSV is quoted only where it must be', () => {
  expect(['/odom/x', 'a,b', 'say "a"', 1.5].map(csvField)).toEqual([
    '/odom/x',
    '"a,b"',
    '"say ""a"""',
    '1.5',
  ]);
});
