"""Relations between poses, kept as arrays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Edges", "no_edges"]


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
