"""The outline of a robot on the ground."""

from __future__ import annotations

import ast
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import CostGrid

__all__ = ["Footprint", "footprint_cost"]


_CIRCLE_CORNERS = 16


@dataclass(frozen=True)
class Footprint:
    """A polygon in the robot's frame.

    Attributes:
        corners: x, y in metres, in order around the robot; at least three.
    """

    corners: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        """Check the polygon."""
        if len(self.corners) < 3:
            raise ValueError(f"a footprint has at least 3 corners, this has {len(self.corners)}")

    @classmethod
    def of_radius(cls, radius_m: float) -> Footprint:
        """Return the 16 corners that ``costmap_2d`` makes of ``robot_radius``."""
        angles = np.arange(_CIRCLE_CORNERS) * math.tau / _CIRCLE_CORNERS
        return cls(tuple((radius_m * math.cos(a), radius_m * math.sin(a)) for a in angles))

    @classmethod
    def parse(cls, value: Any) -> Footprint:
        """Read ``[[x, y], …]``, a list or a text.

        Raises:
            ValueError: it is none; the text says what is wrong.
        """
        if isinstance(value, str):
            try:
                value = ast.literal_eval(value.strip())
            except (ValueError, SyntaxError, MemoryError, RecursionError):
                raise ValueError(f"{value!r} is not [[x1, y1], [x2, y2], …]") from None
        if not isinstance(value, list | tuple):
            raise ValueError(f"{value!r} is not [[x1, y1], [x2, y2], …]")
        return cls(tuple(_corner(item) for item in value))

    @cached_property
    def points(self) -> NDArray[np.float64]:
        """The corners, shape (n, 2)."""
        return np.array(self.corners, float)

    @cached_property
    def inscribed_m(self) -> float:
        """Radius of the largest circle around the robot's origin within the outline."""
        return float(min(_distance(a, b) for a, b in self._edges()))

    @cached_property
    def circumscribed_m(self) -> float:
        """Radius of the smallest circle around the robot's origin that holds the outline."""
        return float(np.hypot(*self.points.T).max())

    def padded(self, padding_m: float) -> Footprint:
        """Return it with every coordinate moved outwards, as ``footprint_padding`` does."""
        return Footprint(
            tuple(
                (
                    x + math.copysign(padding_m, x) * (x != 0),
                    y + math.copysign(padding_m, y) * (y != 0),
                )
                for x, y in self.corners
            )
        )

    def at(self, pose: tuple[float, float, float]) -> NDArray[np.float64]:
        """Return the corners of a robot at a pose, shape (n, 2)."""
        c, s = math.cos(pose[2]), math.sin(pose[2])
        turn = np.array([[c, s], [-s, c]])
        return np.asarray(self.points @ turn + np.array(pose[:2]))

    def _edges(self) -> list[tuple[tuple[float, float], tuple[float, float]]]:
        return list(zip(self.corners, (*self.corners[1:], self.corners[0]), strict=True))


def _corner(item: Any) -> tuple[float, float]:
    try:
        x, y = item
        corner = float(x), float(y)
    except (OverflowError, TypeError, ValueError):
        raise ValueError(f"a corner of a footprint is [x, y], not {item!r}") from None
    if not all(map(math.isfinite, corner)):
        raise ValueError(f"a corner of a footprint is finite, not {item!r}")
    return corner


def _distance(a: tuple[float, float], b: tuple[float, float]) -> float:
    """Return the distance of the origin to the line between two points."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    share = 0.0 if square == 0 else min(max(-(a[0] * dx + a[1] * dy) / square, 0.0), 1.0)
    return math.hypot(a[0] + share * dx, a[1] + share * dy)


def footprint_cost(grid: CostGrid, footprint: Footprint, pose: tuple[float, float, float]) -> int:
    """Return the highest cost under a robot's centre and outline.

    Returns:
        0 … 253 where it fits; −1 when an obstacle is in the way, −2 when it stands on what is
        unknown, −3 when it is outside the grid, as ``CostmapModel::footprintCost``.
    """
    from gazelle.navigation.costmap.costmap_kernels import outline_cost

    x, y, yaw = pose
    return int(
        outline_cost(
            grid.cells, footprint.points, float(x), float(y), math.cos(yaw), math.sin(yaw), 1.0
        )
    )
