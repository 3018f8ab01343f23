"""Relations between poses, kept as arrays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.mapping.se2 import Poses

__all__ = ["DOUBTFUL", "UNKNOWN", "Edges", "bounded", "doubtful", "no_edges", "seen_from"]


DOUBTFUL = np.diag([0.5**-2, 0.5**-2, 0.5**-2])

"""Of relations that may be wrong, such as those of matches that are not the only ones."""

UNKNOWN = np.diag([4.0**-2, 4.0**-2, 2.0**-2])

"""Of what happened while nothing fitted: a robot may have been carried away."""

_MIN_SIGMA = np.diag([0.02**2, 0.02**2, 0.006**2])

_FAINT = np.diag([1e-2, 1e-2, 1e-1])


def bounded(information: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return it, (3, 3), with standard deviations of at least 2 cm and 0.35°.

    Points of one scan err together (in time, in the lidar's mounting, on glass), so that thousands
    of them are no better.
    """
    covariance = np.linalg.inv(information + _FAINT)
    return np.linalg.inv(covariance + _MIN_SIGMA)


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


class Edges(NamedTuple):
    """Relations: pose `head` as seen from pose `tail`.

    Attributes:
        tail, head: indices of poses, int64 (m,).
        relative: measured ``tail⁻¹ ⊕ head``, (m, 3).
        information: inverse covariances in the frame of the tail, (m, 3, 3).
        is_loop: whether one is a loop closure, whose influence is limited, (m,).
    """

    tail: NDArray[np.int64]
    head: NDArray[np.int64]
    relative: NDArray[np.float64]
    information: NDArray[np.float64]
    is_loop: NDArray[np.bool_]

    def with_edge(
        self, tail: int, head: int, relative: ArrayLike, information: ArrayLike, *, is_loop: bool
    ) -> Edges:
        """Return these and one more."""
        return Edges(
            np.append(self.tail, tail),
            np.append(self.head, head),
            np.append(self.relative, np.reshape(relative, (1, 3)), axis=0),
            np.append(self.information, np.reshape(information, (1, 3, 3)), axis=0),
            np.append(self.is_loop, is_loop),
        )

    def only(self, keep: NDArray[np.bool_]) -> Edges:
        """Return those of n that are kept, (n,)."""
        parts: list[Any] = [column[keep] for column in self]
        return Edges(*parts)

    def joined(self, other: Edges) -> Edges:
        """Return these and others."""
        parts: list[Any] = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        return Edges(*parts)


def no_edges() -> Edges:
    """Return an empty set."""
    index = np.empty(0, np.int64)
    return Edges(index, index, np.empty((0, 3)), np.empty((0, 3, 3)), np.empty(0, bool))
