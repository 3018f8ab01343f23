"""Numbers that a world takes must be finite: one that is not would be in all of it a step later."""

from __future__ import annotations

import math
from collections.abc import Iterable

from gazelle.errors import EngineError
from gazelle.geometry import Pose

__all__ = ["finite", "require_finite", "require_finite_pose"]


def finite(value: float, what: str) -> float:
    """Return a number as it is.

    Raises:
        EngineError: it is infinite or none.
    """
    if not math.isfinite(value):
        raise EngineError(f"{what} was given {value}: a finite number is needed")
    return float(value)


def require_finite(values: Iterable[float], what: str) -> None:
    """See that numbers are finite.

    Raises:
        EngineError: one is not.
    """
    for value in values:
        finite(value, what)


def require_finite_pose(pose: Pose, what: str) -> None:
    """See that position and orientation are finite.

    Raises:
        EngineError: one is not.
    """
    require_finite((*pose.position_m, *pose.quat_xyzw), f"the pose of {what}")
