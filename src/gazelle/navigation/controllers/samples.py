"""Velocities that sampling controllers try."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["grid_of_samples", "samples_between"]


def samples_between(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return evenly spaced velocities, (n,), with 0 among them where it lies between.

    This is ``VelocityIterator`` of base_local_planner.
    """
    if low >= high:
        return np.array([low])
    values = np.linspace(low, high, max(count, 2))
    if low < 0 < high:
        values = np.union1d(values, [0.0])
    return values


def grid_of_samples(
    low: NDArray[np.float64], high: NDArray[np.float64], counts: tuple[int, int, int]
) -> NDArray[np.float64]:
    """Return all combinations of x, y and turning velocities, (n, 3), x slowest."""
    axes = [samples_between(float(low[k]), float(high[k]), counts[k]) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
