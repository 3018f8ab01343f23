"""How much is known of a relation, as inverse covariances in the plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.poses import Poses

__all__ = ["DOUBTFUL", "UNKNOWN", "bounded", "doubtful", "seen_from"]

DOUBTFUL = np.diag([0.5**-2, 0.5**-2, 0.5**-2])
"""Of relations that may be wrong, such as those of matches that are not the only ones."""

UNKNOWN = np.diag([4.0**-2, 4.0**-2, 2.0**-2])
"""Of what happened while nothing fitted: a robot may have been carried away."""

_LEAST_SIGMA = np.diag([0.02**2, 0.02**2, 0.006**2])
_FAINT = np.diag([1e-2, 1e-2, 1e-1])


def bounded(information: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return it, (3, 3), with standard deviations of at least 2 cm and 0.35°.

    Points of one scan err together (in time, in the lidar's mounting, on glass), so that thousands
    of them are no better.
    """
    covariance = np.linalg.inv(information + _FAINT)
    return np.linalg.inv(covariance + _LEAST_SIGMA)


def doubtful(information: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which of some relations, (m, 3, 3), may be wrong."""
    return np.asarray(information[:, 2, 2] <= 1.01 * DOUBTFUL[2, 2])


def seen_from(pose: Poses, information: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return information about x, y, yaw of the map as information in the frame of a pose.

    Args:
        pose: (3,), or many, (…, 3).
        information: (3, 3), or as many, (…, 3, 3).
    """
    cos, sin = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    turn = np.zeros((*pose.shape, 3))
    turn[..., 0, 0], turn[..., 0, 1], turn[..., 1, 0], turn[..., 1, 1] = cos, -sin, sin, cos
    turn[..., 2, 2] = 1.0
    return np.asarray(np.swapaxes(turn, -1, -2) @ information @ turn)
