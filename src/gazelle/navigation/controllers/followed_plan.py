"""The part of a path that lies before a robot."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import CostGrid

__all__ = ["FollowedPlan", "angle_between", "densified"]

Pose = tuple[float, float, float]

_AS_NEAR_M = 0.1


def angle_between(a_rad: float, b_rad: float) -> float:
    """Return the turn from one direction to another, in [−π, π]."""
    return math.remainder(b_rad - a_rad, math.tau)


def densified(plan: NDArray[np.float64], step_m: float) -> NDArray[np.float64]:
    """Return a path (m, 3) with points at most so far apart, from poses (n, 3), m and rad.

    New points have the direction before them.
    """
    if len(plan) < 2:
        return plan
    parts = [plan[:1]]
    for a, b in itertools.pairwise(plan):
        count = max(math.ceil(math.hypot(b[0] - a[0], b[1] - a[1]) / step_m), 1)
        share = np.arange(1, count + 1)[:, None] / count
        part = np.column_stack([a[:2] + (b[:2] - a[:2]) * share, np.full(count, a[2])])
        part[-1, 2] = b[2]
        parts.append(part)
    return np.concatenate(parts)


class FollowedPlan:
    """A path and how far along it a robot is.

    Attributes:
        poses: (n, 3), densely.
        begin: index of the point nearest to the robot.
    """

    def __init__(
        self, plan: NDArray[np.float64], step_m: float = 0.05, *, before: FollowedPlan | None = None
    ) -> None:
        """Take a path.

        Args:
            plan: (n, 3) poses.
            step_m: between two of them at most.
            before: the same path in a frame that has drifted, of which as much is behind.

        Raises:
            ValueError: it is empty, or not (n, 3) finite numbers.
        """
        plan = np.asarray(plan, float)
        if plan.ndim != 2 or plan.shape[1] != 3 or not len(plan) or not np.isfinite(plan).all():
            raise ValueError("a path is (n, 3) finite numbers, at least one row")
        self.poses = densified(plan, step_m)
        self.begin: int = 0 if before is None else min(before.begin, len(self.poses) - 1)
        steps = np.hypot(*np.diff(self.poses[:, :2], axis=0).T)
        self._along = np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def goal(self) -> Pose:
        """The last pose."""
        x, y, yaw = map(float, self.poses[-1])
        return x, y, yaw

    def advance(self, pose: Pose, search_m: float) -> int:
        """Find the nearest point within a length ahead, and remember it.

        What was passed is not gone back to, and where a path comes by again it is the first time
        that counts, so that paths that cross themselves or lead back are followed in order.
        """
        last = int(np.searchsorted(self._along, self._along[self.begin] + search_m, "right"))
        part = self.poses[self.begin : max(last, self.begin + 1), :2]
        away = np.hypot(*(part - pose[:2]).T)
        is_near = away <= away.min() + _AS_NEAR_M
        first = int(is_near.argmax())
        beyond = np.nonzero(~is_near[first:])[0]
        end = first + int(beyond[0]) if len(beyond) else len(away)
        self.begin += first + int(away[first:end].argmin())
        return self.begin

    def ahead(self, length_m: float) -> Pose:
        """Return the pose so far along the path from the nearest point, at most the goal.

        Its direction is the path's there, in the goal that which is wanted.
        """
        index = int(np.searchsorted(self._along, self._along[self.begin] + length_m))
        if index >= len(self.poses) - 1:
            return self.goal
        step = self.poses[index + 1, :2] - self.poses[index, :2]
        x, y = map(float, self.poses[index, :2])
        return x, y, math.atan2(step[1], step[0])

    def remaining_m(self) -> float:
        """Return the length from the nearest point to the goal."""
        return float(self._along[-1] - self._along[self.begin])

    def local(
        self, pose: Pose, grid: CostGrid, behind_m: float = math.inf, ahead_m: float = math.inf
    ) -> NDArray[np.float64]:
        """Return the part, (n, 3), around the robot that lies in the window of a costmap.

        The window ends half its larger side away from the robot, as ``transformGlobalPlan`` has it.
        """
        reach = max(grid.width, grid.height) * grid.resolution_m / 2
        self.advance(pose, 2 * reach)
        here = self._along[self.begin]
        near = np.hypot(*(self.poses[:, :2] - pose[:2]).T) <= reach
        kept = near & (self._along >= here - behind_m) & (self._along <= here + ahead_m)
        after = np.nonzero(~kept[self.begin :])[0]
        before = np.nonzero(~kept[: self.begin])[0]
        end = self.begin + (int(after[0]) if len(after) else len(kept))
        start = int(before[-1]) + 1 if len(before) else 0
        return self.poses[start : max(end, self.begin + 1)]
