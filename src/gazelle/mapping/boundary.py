"""Polygons around what is to be explored."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["are_inside", "perimeter_m"]


def are_inside(points: ArrayLike, corners: ArrayLike) -> NDArray[np.bool_]:
    """Return which points lie in a polygon, by the number of edges to their right (even-odd).

    Args:
        points: (n, 2), m.
        corners: (m, 2), m, in order; the last one is joined to the first. With fewer than three
            nothing lies inside.
    """
    x, y = np.asarray(points, float).reshape(-1, 2).T
    inside = np.zeros(len(x), np.bool_)
    around = np.asarray(corners, float).reshape(-1, 2)
    for (ax, ay), (bx, by) in zip(around, np.roll(around, 1, axis=0), strict=True):
        if ay != by:
            crosses = (ay > y) != (by > y)
            inside ^= crosses & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    return inside


def perimeter_m(corners: ArrayLike) -> float:
    """Return the length of a polygon's outline; (m, 2) corners, m."""
    around = np.asarray(corners, float).reshape(-1, 2)
    return float(np.hypot(*(around - np.roll(around, 1, axis=0)).T).sum())
