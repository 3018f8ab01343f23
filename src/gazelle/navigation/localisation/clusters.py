"""Which particles belong together, and what they amount to."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

__all__ = ["best_cluster", "statistics"]

_CELL = np.array([0.5, 0.5, math.pi / 18])
_MOST_CELLS = 20_000_000
_ANGLES = 36


def statistics(
    particles: NDArray[np.float64], weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean pose (3,) and covariance (3, 3); of angles the circular ones, as amcl."""
    total = float(weights.sum())
    share = weights / total if total > 0 else np.full(len(weights), 1 / len(weights))
    place = share @ particles[:, :2]
    c, s = share @ np.cos(particles[:, 2]), share @ np.sin(particles[:, 2])
    covariance = np.zeros((3, 3))
    off = particles[:, :2] - place
    covariance[:2, :2] = (off * share[:, None]).T @ off
    covariance[2, 2] = -2 * math.log(min(max(math.hypot(c, s), 1e-12), 1.0))
    return np.append(place, math.atan2(s, c)), covariance


def best_cluster(
    particles: NDArray[np.float64], weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean pose (3,) and covariance (3, 3) of the heaviest group of particles.

    Particles of neighbouring cells of 0.5 m × 0.5 m × 10° belong together.
    """
    cells = np.floor(particles / _CELL).astype(np.int64)
    cells[:, 2] %= _ANGLES
    low = cells[:, :2].min(axis=0)
    size = cells[:, :2].max(axis=0) - low + 1
    if int(size[0]) * int(size[1]) * _ANGLES > _MOST_CELLS:
        return statistics(particles, weights)
    # One slice more on either side of the angles, so that neighbours across ±180° are seen.
    held = np.zeros((size[0], size[1], _ANGLES + 1), bool)
    column, row, angle = cells[:, 0] - low[0], cells[:, 1] - low[1], cells[:, 2]
    held[column, row, angle] = True
    held[..., _ANGLES] = held[..., 0]
    labels, count = label(held, structure=np.ones((3, 3, 3)))
    same = np.arange(count + 1)
    for a, b in zip(labels[..., 0].ravel(), labels[..., _ANGLES].ravel(), strict=True):
        if a and same[a] != same[b]:
            same[same == same[b]] = same[a]
    groups = same[labels[column, row, angle]]
    sums = np.bincount(groups, weights)
    best = int(sums.argmax())
    chosen = groups == best
    return statistics(particles[chosen], weights[chosen])
