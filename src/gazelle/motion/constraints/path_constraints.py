"""Constraints along a path: which configurations keep them, and how to get to one that does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.motion.constraints.kinematic_constraints import JointConstraint, PathConstraint
from gazelle.motion.joint_space import FloatArray, JointSpace, Validity

__all__ = ["Constrained", "narrowed", "projection"]

_SLACK = 1e-6
_ITERATIONS = 40
_SHARE = 0.7
_DAMPING = 1e-6
_MAX_STEP = 0.3
_DIFFERENCE = 1e-6


@dataclass(frozen=True)
class Constrained:
    """A `Validity` that path constraints must allow too.

    Attributes:
        validity: collisions and limits.
        constraints: all of them must hold.
    """

    validity: Validity
    constraints: tuple[PathConstraint, ...]

    def is_valid(self, q: FloatArray) -> bool:
        """Return whether all constraints hold and the robot may be at `q` (n,)."""
        return self._hold(q) and self.validity.is_valid(q)

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        """Return whether all constraints hold all along a free motion from `q0` to `q1`, (n,)."""
        count = max(1, int(np.ceil(np.linalg.norm(q1 - q0) / step)))
        way = (q1 - q0) / count
        holds = all(self._hold(q0 + way * k) for k in range(count, 0, -1))
        return holds and self.validity.motion_is_valid(q0, q1, step)

    def why(self, q: FloatArray) -> str:
        """Return which constraints or what else forbids `q` (n,)."""
        broken = [item.why(q) for item in self.constraints if _exceeds(item, q)]
        return "; ".join(filter(None, [*broken, self.validity.why(q)]))

    def _hold(self, q: FloatArray) -> bool:
        return not any(_exceeds(item, q) for item in self.constraints)


def narrowed(space: JointSpace, constraints: Sequence[PathConstraint]) -> JointSpace:
    """Return the space with limits as narrow as its joint constraints.

    Joint constraints then cost nothing: no configuration outside is ever drawn.

    Raises:
        ValueError: a constraint lies outside the limits of its joint.
    """
    lower, upper = np.full(space.size, -np.inf), np.full(space.size, np.inf)
    for item in constraints:
        if isinstance(item, JointConstraint):
            low, high = item.position - item.tolerance_below, item.position + item.tolerance_above
            lower[item.index] = max(lower[item.index], low)
            upper[item.index] = min(upper[item.index], high)
    return space.restricted(lower, upper)


def projection(
    space: JointSpace, constraints: Sequence[PathConstraint]
) -> Callable[[FloatArray], FloatArray | None] | None:
    """Return a function that moves a configuration (n,) into the constraints of links.

    None where there are none. The function is a damped Gauss-Newton iteration and returns None
    where it does not arrive.
    """
    of_links = [item for item in constraints if not isinstance(item, JointConstraint)]
    if not of_links:
        return None

    def residual(q: FloatArray, share: float) -> FloatArray:
        return np.concatenate([item.excess(q, share) for item in of_links])

    def project(q: FloatArray) -> FloatArray | None:
        if not residual(q, 1.0).any():
            return q
        for _ in range(_ITERATIONS):
            # The margin keeps straight motions between two projected configurations inside.
            error = residual(q, _SHARE)
            if float(np.abs(error).max()) < _SLACK:
                return q
            columns = _jacobian(lambda x: residual(x, _SHARE), q, error)
            square = columns @ columns.T + _DAMPING * np.eye(len(error))
            step = -columns.T @ np.linalg.solve(square, error)
            length = float(np.linalg.norm(step))
            q = space.clamped(q + step * min(1.0, _MAX_STEP / max(length, 1e-12)))
        return q if not residual(q, 1.0).any() else None

    return project


def _jacobian(
    function: Callable[[FloatArray], FloatArray], q: FloatArray, value: FloatArray
) -> FloatArray:
    columns = np.empty((len(value), len(q)))
    for joint in range(len(q)):
        moved = q.copy()
        moved[joint] += _DIFFERENCE
        columns[:, joint] = (function(moved) - value) / _DIFFERENCE
    return columns


def _exceeds(item: PathConstraint, q: FloatArray) -> bool:
    return bool((np.abs(item.excess(q)) > _SLACK).any())
