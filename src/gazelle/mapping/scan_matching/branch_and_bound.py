"""Search of wide windows by branch and bound, for places seen before."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.scan_matching import branch_and_bound_kernels
from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.se2 import Poses

__all__ = ["WideMatch", "WideSearch", "best_of_sectors"]

# Sides of the largest blocks, in powers of two.
_MAX_DEPTH = 6


class WideMatch(NamedTuple):
    """The best pose of a window.

    Attributes:
        pose: to a cell, (3,) in the field's frame: x, y (m) and yaw (rad).
        value: mean value of the points there.
    """

    pose: Poses
    value: float


class WideSearch:
    """Searches windows around one pose; what windows of several sizes share is made once."""

    def __init__(
        self, field: Field, points_m: NDArray[np.float64], center: Poses, turns: NDArray[np.float64]
    ) -> None:
        """Prepare a search.

        Args:
            field: what is matched with; its cells are the steps of the search.
            points_m: in the robot's frame, (n, 2), one at least.
            center: of the windows.
            turns: which are tried, from the centre's heading, ascending.
        """
        self._field = field
        self._center = center
        self._turns = turns
        x, y = float(center[0]) - field.x_m, float(center[1]) - field.y_m
        self._cells, self._boxes = branch_and_bound_kernels.cells_of(
            points_m, x, y, center[2] + turns, field.cell_m, field.values.shape[1]
        )
        self._levels = _Levels(field.values)

    @classmethod
    def around(
        cls, field: Field, points_m: NDArray[np.float64], center: Poses, reach_rad: float
    ) -> WideSearch:
        """Prepare a search of all turns so far to both sides.

        Args:
            field: what is matched with.
            points_m: (n, 2) in the robot's frame.
            center: pose (3,) in the field's frame: x, y (m) and yaw (rad).
            reach_rad: largest turn.
        """
        return cls(field, points_m, center, _turns(points_m, field.cell_m, reach_rad))

    def best(
        self, reach_m: float, *, least: float, done_m: float | None = None
    ) -> WideMatch | None:
        """Return the best pose within a window, to a cell, None when its mean value is too low.

        Args:
            reach_m: half side of the window.
            least: mean value that must be exceeded.
            done_m: half side of a smaller window in which nothing exceeds it, as is known.
        """
        found = self._searched(slice(None), reach_m, least, done_m)
        return found[0] if found else None

    def best_of_parts(self, parts: int, reach_m: float, *, least: float) -> list[WideMatch]:
        """Return the best pose of every part of the turns, as far as they exceed a value."""
        bounds = np.cumsum([0] + [len(one) for one in np.array_split(self._turns, parts)]).tolist()
        found: list[WideMatch] = []
        for begin, end in pairwise(bounds):
            found += self._searched(slice(begin, end), reach_m, least, None)
        return found

    def _searched(
        self, part: slice, reach_m: float, least: float, done_m: float | None
    ) -> list[WideMatch]:
        cell_m = self._field.cell_m
        reach = _in_cells(reach_m, cell_m)
        done = -1 if done_m is None else _in_cells(done_m, cell_m)
        largest = min(_MAX_DEPTH, max(branch_and_bound_kernels.LEAF, int(math.log2(reach))))
        turn, columns, rows, value = branch_and_bound_kernels.bound_search(
            self._field.values, self._levels.words, self._levels.up_to(largest),
            self._cells[part], self._boxes[part], reach, done, least,
        )  # fmt: skip
        if turn < 0:
            return []
        x, y = self._center[0] + columns * cell_m, self._center[1] + rows * cell_m
        yaw = self._center[2] + self._turns[part][turn]
        return [WideMatch(np.array([x, y, yaw]), float(value))]


class _Levels:
    """Greatest values of ever larger squares, made when they are asked for."""

    def __init__(self, values: NDArray[np.float32]) -> None:
        bytes_ = np.empty(values.shape, np.uint8)
        branch_and_bound_kernels.rounded_up(values, bytes_)
        self.words = np.empty(values.shape, np.uint64)
        branch_and_bound_kernels.packed(bytes_, self.words)
        self._levels = np.empty(
            (_MAX_DEPTH - branch_and_bound_kernels.LEAF + 1, *values.shape), np.uint8
        )
        pair = np.empty_like(bytes_)
        branch_and_bound_kernels.sliding(bytes_, 1, pair)
        branch_and_bound_kernels.sliding(pair, 2, self._levels[0])
        self._made = 1

    def up_to(self, largest: int) -> NDArray[np.uint8]:
        """Return those of squares of 2^LEAF to 2^largest cells a side."""
        count = largest - branch_and_bound_kernels.LEAF + 1
        for h in range(self._made, count):
            step = 1 << (h - 1 + branch_and_bound_kernels.LEAF)
            branch_and_bound_kernels.sliding(self._levels[h - 1], step, self._levels[h])
        self._made = max(self._made, count)
        return self._levels[:count]


def best_of_sectors(
    field: Field,
    points_m: NDArray[np.float64],
    center: Poses,
    *,
    reach_m: float,
    reach_rad: float,
    sector_rad: float,
    least: float,
) -> list[WideMatch]:
    """Return the best pose of every sector of turns, to a cell, as far as they exceed a value.

    Args:
        field: what is matched with; its cells are the steps of the search.
        points_m: in the robot's frame, (n, 2).
        center: of the window.
        reach_m: half side of the window.
        reach_rad: the same for turns.
        sector_rad: width of a sector, about.
        least: mean value that must be exceeded.
    """
    if not len(points_m):
        return []
    sectors = max(1, round(2 * reach_rad / sector_rad))
    search = WideSearch.around(field, points_m, center, reach_rad)
    return search.best_of_parts(sectors, reach_m, least=least)


def _in_cells(reach_m: float, cell_m: float) -> int:
    return max(1, math.ceil(reach_m / cell_m))


def _turns(points_m: NDArray[np.float64], cell_m: float, reach_rad: float) -> NDArray[np.float64]:
    """Return turns that move the farthest point by about a cell each (Olson 2009)."""
    farthest = float(np.sqrt((points_m**2).sum(axis=1).max()))
    step = max(0.01, cell_m / max(farthest, cell_m))
    count = math.ceil(reach_rad / step)
    return np.asarray(np.arange(-count, count + 1) * step, dtype=np.float64)
