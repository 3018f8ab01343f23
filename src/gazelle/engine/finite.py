"""Numbers that a world takes must be finite: one that is not would be in all of it a step later.

Places must be within bounds besides: a state whose squares are beyond all numbers is none that a
world could go on from, or go back to.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from gazelle.errors import EngineError
from gazelle.geometry import Pose

__all__ = ["finite", "place", "require_finite", "require_finite_pose"]

_FARTHEST = 1e12


def finite(value: float, what: str) -> float:
    """Return a number as it is.

    Raises:
        EngineError: it is infinite or none.
    """
    if not math.isfinite(value):
        raise EngineError(f"{what} was given {value}: a finite number is needed")
    return float(value)


def place(value: float, what: str) -> float:
    """Return a coordinate, or the position of a joint, as it is.

    Raises:
        EngineError: it is infinite, none, or beyond all bounds.
    """
    if abs(finite(value, what)) > _FARTHEST:
        raise EngineError(f"{what} was given {value:g}: nothing is farther away than {_FARTHEST:g}")
    return float(value)


def require_finite(values: Iterable[float], what: str) -> None:
    """See that numbers are finite.

    Raises:
        EngineError: one is not.
    """
    for value in values:
        finite(value, what)


def require_finite_pose(pose: Pose, what: str) -> None:
    """See that position and orientation are finite, and the position within bounds.

    Raises:
        EngineError: a number is not.
    """
    for value in pose.position_m:
        place(value, f"the pose of {what}")
    require_finite(pose.quat_xyzw, f"the pose of {what}")
