import { expect, test } from 'vitest';
import { eigen } from '../../src/displays/covariance';

test('eigenvalues are on the diagonal of a diagonal matrix', () => {
  expect(
    eigen([
      [4, 0, 0],
      [0, 9, 0],
      [0, 0, 1],
    ]).squares,
  ).toEqual([4, 9, 1]);
});

test('every axis is stretched by its eigenvalue', () => {
  const matrix = [
    [4, 1, -0.5],
    [1, 3, 0.25],
    [-0.5, 0.25, 2],
  ];
  const { axes, squares } = eigen(matrix);
  axes.forEach((axis, index) => {
    expect(Math.hypot(...axis)).toBeCloseTo(1, 12);
    matrix.forEach((row, k) => {
      const stretched = row.reduce((sum, value, column) => sum + value * axis[column], 0);
      expect(stretched).toBeCloseTo(squares[index] * axis[k], 9);
    });
  });
});
