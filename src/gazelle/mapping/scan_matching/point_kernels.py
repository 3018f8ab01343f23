# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled inner loop of putting surfaces where scans were taken."""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit

__all__ = ["placed"]


@njit(cache=True, nogil=True)
def placed(points, starts, poses, indices):
    """Return the points of some sets, each moved to its pose, (m, 2).

    Args:
        points: of all sets, one after the other, (n, 2).
        starts: where each set begins, int64, and where the last one ends.
        poses: of the sets, (s, 3) at least.
        indices: which sets, int64.
    """
    count = 0
    for k in range(indices.shape[0]):
        count += starts[indices[k] + 1] - starts[indices[k]]
    out = np.empty((count, 2))
    at = 0
    for k in range(indices.shape[0]):
        pose = poses[indices[k]]
        c, s = math.cos(pose[2]), math.sin(pose[2])
        for i in range(starts[indices[k]], starts[indices[k] + 1]):
            out[at, 0] = c * points[i, 0] - s * points[i, 1] + pose[0]
            out[at, 1] = s * points[i, 0] + c * points[i, 1] + pose[1]
            at += 1
    return out
