"""Likelihood fields: how likely a beam ends at each place, from what earlier scans met."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.mapping.scan_matching import matching_kernels
from gazelle.mapping.scan_matching.match_arguments import FieldCells, Lines
from gazelle.mapping.scan_matching.settings import FieldSettings

__all__ = ["Field", "field_of"]

_USUAL = FieldSettings()


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """A likelihood field.

    Attributes:
        values: float32 (height, width) within [0, 1], row 0 lowest y.
        x_m, y_m: lower left corner.
        cell_m: side of a cell.
        lines: of its surfaces; None in coarse fields.
    """

    values: NDArray[np.float32]
    x_m: float
    y_m: float
    cell_m: float
    lines: Lines | None = None

    @property
    def cells(self) -> FieldCells:
        """What kernels take of it."""
        return FieldCells(self.values, self.x_m, self.y_m, self.cell_m)

    def pooled(self) -> Field:
        """Return it with cells twice as large, each the greatest of its four parts."""
        return Field(matching_kernels.pooled(self.values), self.x_m, self.y_m, 2 * self.cell_m)

    def mean(self, points_m: NDArray[np.float64], pose: ArrayLike) -> float:
        """Return the mean value at points (n, 2), m, seen from a pose (3,) of the field's frame.

        It is 1 when all lie on surfaces.
        """
        x, y, yaw = np.asarray(pose, dtype=float)
        return float(matching_kernels.mean_value(self.cells, points_m, x, y, yaw))


def field_of(
    points_m: NDArray[np.float64],
    center_m: tuple[float, float],
    half_side_m: float,
    *,
    cell_m: float,
    sigma_m: float,
    settings: FieldSettings = _USUAL,
) -> Field:
    """Return the square field of surfaces.

    Args:
        points_m: the surfaces, shape (n, 2), dense against the cells.
        center_m: middle of the square.
        half_side_m: of the square.
        cell_m: side of a cell.
        sigma_m: how far beams end from their surface, standard deviation.
        settings: how it is made.
    """
    side = max(8, int(2 * half_side_m / cell_m) // 8 * 8)
    values = np.zeros((side, side), np.float32)
    x0, y0 = center_m[0] - half_side_m, center_m[1] - half_side_m
    cells = FieldCells(values, x0, y0, cell_m)
    matching_kernels.stamp(cells, points_m, _kernels(sigma_m, cell_m, settings.parts))
    line_cell_m = settings.line_cell_m
    across = math.ceil(side * cell_m / line_cell_m)
    places = np.zeros((across, across), np.int32)
    sums = np.empty((len(points_m) + 1, 6))
    lines = Lines(places, sums, x0, y0, line_cell_m)
    used = matching_kernels.accumulate(lines, points_m)
    return Field(values, x0, y0, cell_m, lines._replace(sums=sums[:used]))


@lru_cache(maxsize=16)
def _kernels(sigma_m: float, cell_m: float, count: int) -> NDArray[np.float32]:
    """Return bells around points of every part of a cell, (parts, parts, side, side)."""
    reach = math.ceil(2.5 * sigma_m / cell_m)
    cells = np.arange(-reach, reach + 1)
    parts = (np.arange(count) + 0.5) / count - 0.5
    away = (cells[None, :] - parts[:, None]) * cell_m
    bell = np.exp(-(away**2) / (2 * sigma_m**2))
    return (bell[:, None, :, None] * bell[None, :, None, :]).astype(np.float32)
