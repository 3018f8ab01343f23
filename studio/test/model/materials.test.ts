import { expect, test } from 'vitest';
import { parseColour } from '../../src/model/materials';

test('colours of RViz are parts of 255, white where nothing can be read', () => {
  expect(parseColour('255; 51; 0')).toEqual([1, 0.2, 0]);
  expect(parseColour('0 255 102')).toEqual([0, 1, 0.4]);
  expect(parseColour('red')).toEqual([1, 1, 1]);
});
