import { expect, test } from 'vitest';
import { isObject, numberOf, textOf, textsOf } from '../src/json';

test('neither null nor a list is an object', () => {
  expect([{}, null, [], 'text', 1].map(isObject)).toEqual([true, false, false, false, false]);
});

test('a value of another type counts as missing', () => {
  const value = { name: 3, count: '3', names: ['a', 1, 'b'], one: 'a' };
  expect(textOf(value, 'name', 'none')).toBe('none');
  expect(numberOf(value, 'count', -1)).toBe(-1);
  expect(textsOf(value, 'names')).toEqual(['a', 'b']);
  expect(textsOf(value, 'one')).toEqual([]);
});
