import { expect, test } from 'vitest';
import { valueFromText } from '../../src/widgets/value_text';

test.each([
  ['true', true],
  ['Off', false],
  [' 12 ', 12],
  ['-.5e3', -500],
  ['[1, 2]', [1, 2]],
  ['{"a": null}', { a: null }],
  ['"12"', '12'],
])('%s is a value', (typed, value) => {
  expect(valueFromText(typed)).toEqual(value);
});

test.each(['base_link', '1.2.3', '0x10', '[1, 2', ''])('%s is a text', (typed) => {
  expect(valueFromText(typed)).toBe(typed);
});
