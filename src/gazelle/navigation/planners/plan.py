"""What a planner gives: a path, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

__all__ = ["NoPlan", "Plan", "PlanFailure"]


class PlanFailure(Enum):
    """Why there is no path; the values are the words of Nav2's error codes."""

    START_OUTSIDE_MAP = "START_OUTSIDE_MAP"
    GOAL_OUTSIDE_MAP = "GOAL_OUTSIDE_MAP"
    START_OCCUPIED = "START_OCCUPIED"
    GOAL_OCCUPIED = "GOAL_OCCUPIED"
    NO_VALID_PATH = "NO_VALID_PATH"


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A path from where the robot is to the goal.

    Attributes:
        poses: (n, 3), x, y (m) and yaw (rad) in the costmap's frame; the last one is the goal, or
            the reachable place nearest to it.
        cost: of the planner's own measure.
    """

    poses: NDArray[np.float64]
    cost: float

    @property
    def length_m(self) -> float:
        """Length of the path."""
        return float(np.hypot(*np.diff(self.poses[:, :2], axis=0).T).sum())


@dataclass(frozen=True, slots=True)
class NoPlan:
    """Why there is no path.

    Attributes:
        failure: in Nav2's terms.
        reason: in words, with places and costs.
    """

    failure: PlanFailure
    reason: str
