"""Trees of configurations that can say which of their nodes is nearest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.planning.search_tree_kernels import drawn, nearest

__all__ = ["Tree", "TreeArrays", "warm_up_trees"]

_TURN = 2.0 * math.pi


class TreeArrays(NamedTuple):
    """A tree as kernels take it, with room for more nodes than there are.

    Attributes:
        nodes: (m, n).
        parents: (m,) node above each, -1 for roots.
        domains: (m,) how far each grows, inf where nothing bars it.
        size: how many nodes there are.
    """

    nodes: FloatArray
    parents: NDArray[np.int64]
    domains: FloatArray
    size: int


@cache
def warm_up_trees() -> None:
    """Compile or load the kernels of trees, before the time that somebody has for planning."""
    joint = JointSpace(("j",), *np.array([[0.0], [1.0]]), *np.zeros((4, 1)))
    tree = Tree(joint, [np.zeros(1)])
    tree.nearest(np.zeros(1))
    tree.drawn(np.zeros((1, 1)))


class Tree:
    """Nodes in one growing array; a brute search of some thousand beats any index.

    Attributes:
        parents: node above each, -1 for roots; longer than there are nodes.
    """

    def __init__(self, space: JointSpace, roots: Sequence[FloatArray]) -> None:
        """Start a tree, or a forest where there are several roots."""
        self._space = space
        self._nodes = np.empty((256, space.size))
        self._difference = np.empty((256, space.size))
        self._domains = np.full(256, np.inf)
        self._turning = np.flatnonzero(space.continuous)
        self._count = 0
        self.parents = np.empty(256, np.int64)
        for root in roots:
            self.add(root, -1)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: int) -> FloatArray:
        node: FloatArray = self._nodes[index]
        return node

    @property
    def nodes(self) -> FloatArray:
        """All nodes, shape (m, n); a view that the next `add` may leave behind."""
        return self._nodes[: self._count]

    @property
    def arrays(self) -> TreeArrays:
        """The nodes and what is known of them, for kernels that make the tree grow."""
        return TreeArrays(self._nodes, self.parents, self._domains, self._count)

    @arrays.setter
    def arrays(self, arrays: TreeArrays) -> None:
        self._nodes, self.parents, self._domains, self._count = arrays
        if len(self._difference) < len(self._nodes):
            self._difference = np.empty_like(self._nodes)

    def add(self, q: FloatArray, parent: int) -> int:
        """Add a node `q` (n,) and return its index; `parent` -1 makes it a root."""
        count = self._count
        if count == len(self._nodes):
            self._nodes = np.concatenate([self._nodes, np.empty_like(self._nodes)])
            self._difference = np.empty_like(self._nodes)
            self._domains = np.concatenate([self._domains, np.full(count, np.inf)])
            self.parents = np.concatenate([self.parents, np.empty_like(self.parents)])
        self._nodes[count], self.parents[count] = q, parent
        self._count += 1
        return count

    def squared_distances(self, q: FloatArray) -> FloatArray:
        """Return the squared distance of each node to `q` (n,), (k,), going the short way round."""
        count = self._count
        difference = np.subtract(self._nodes[:count], q, out=self._difference[:count])
        for joint in self._turning:
            column = difference[:, joint]
            column[:] = (column + math.pi) % _TURN - math.pi
        squared: FloatArray = np.einsum("ij,ij->i", difference, difference)
        return squared

    def nearest(self, q: FloatArray) -> int:
        """Return the index of the node nearest to `q` (n,)."""
        return int(nearest(self._nodes, self._count, self._space.continuous, q)[0])

    def drawn(self, chances: FloatArray) -> tuple[FloatArray, int]:
        """Return a draw that the node nearest to it may grow towards, and the node.

        Args:
            chances: (d, n) numbers from 0 to 1; the last row counts wherever it lies.
        """
        space = self._space
        q, node = drawn(
            self._nodes, self._count, space.continuous, self._domains, space.low,
            space.width, chances,
        )  # fmt: skip
        return q, int(node)

    def confine(self, index: int, domain: float) -> None:
        """Let a node grow only towards what is near."""
        self._domains[index] = domain

    def branch(self, index: int) -> list[FloatArray]:
        """Return the nodes, (n,) each, from the root to `index`."""
        nodes = []
        while index >= 0:
            nodes.append(self._nodes[index].copy())
            index = int(self.parents[index])
        return nodes[::-1]
