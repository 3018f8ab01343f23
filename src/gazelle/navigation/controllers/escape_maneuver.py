"""Out of where a controller finds no way on: turns on the spot and straight pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.controller import (
    Command,
    Controller,
    NoCommand,
    RobotState,
    Velocity,
)
from gazelle.navigation.controllers.followed_plan import FollowedPlan, angle_between
from gazelle.navigation.controllers.rollout_arguments import Outline
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.costmap.footprint import Footprint, footprint_cost

__all__ = ["Maneuvering", "Pace"]

Pose = tuple[float, float, float]

# How far ahead on the path a way is looked for, in this order.
_AHEAD_M = (1.2, 0.9, 1.5, 0.6, 0.4)
_NEAR_M = 0.06
# Of the outline: where it touches something already, as much smaller as lets it go.
_SCALES = (1.0, 0.97, 0.94, 0.9)
_REFUSALS = 3
_NOWHERE_S, _NOWHERE_M, _NOWHERE_RAD = 6.0, 0.1, 0.5
# Swinging is no way on either; a path that is so much longer is another one.
_NO_NEARER_S, _NEARER_M, _LONGER_M = 20.0, 0.1, 0.5
_IN_GOAL_M = 0.25
_ON_THE_WAY_M, _ON_THE_WAY_RAD = 0.03, 0.05
_ASTRAY_M = 0.15
_LOOK_AHEAD = 6
_MAX_IN_A_ROW = 4
_SEARCH_M = 3.0


@dataclass(frozen=True, slots=True)
class Pace:
    """How fast maneuvers are driven.

    Attributes:
        m_s, rad_s: highest speeds.
        slowest_rad_s: of turns; slower ones do not happen.
        m_s2: acceleration.
    """

    m_s: float
    rad_s: float
    slowest_rad_s: float
    m_s2: float = 0.5


class Maneuvering:
    """A controller, and what drives on where it finds no way or gets nowhere.

    The originals give up there, or swing to and fro for ever. A way to a place on the path beyond
    is searched for with the robot's outline, of straight pieces, ahead or back, and turns on the
    spot; then the controller goes on.
    """

    def __init__(self, controller: Controller, pace: Pace, period_s: float) -> None:
        """Take over a controller.

        Args:
            controller: what drives otherwise.
            pace: of maneuvers.
            period_s: between two velocity commands.
        """
        self._controller = controller
        self._pace = pace
        self._period_s = period_s
        self._plan: FollowedPlan | None = None
        self._way: NDArray[np.float64] | None = None
        self._at = 0
        self._scale = 1.0
        self._limit_m_s = math.inf
        self._forget()

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path (n, 3); see `Controller`. A maneuver towards the same goal goes on."""
        self._controller.set_plan(plan, has_moved=has_moved)
        held = FollowedPlan(plan, before=self._plan if has_moved else None)
        if self._plan is not None and math.dist(self._plan.goal[:2], held.goal[:2]) > _NOWHERE_M:
            self._forget()
        self._plan = held

    def reset(self) -> None:
        """Forget what was driven."""
        self._controller.reset()
        self._plan = None
        self._forget()

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this."""
        self._limit_m_s = math.inf if m_s is None else m_s
        self._controller.limit_speed(m_s)

    def goal_reached(self, state: RobotState) -> bool:
        """Ask the controller."""
        return self._controller.goal_reached(state)

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._way is not None:
            command = self._drive(state, grid, footprint)
            if command is not None:
                return command
            self._leave(state)
        found = self._controller.compute(state, grid, footprint)
        if self._plan is None or not self._is_stuck(state, found):
            return found
        self._way = self._find(state, grid, footprint)
        self._begin_anew(state)
        if self._way is None:
            return found
        self._at = 1
        command = self._drive(state, grid, footprint)
        return found if command is None else replace(command, note=self._note(found))

    def _note(self, found: Command | NoCommand) -> str:
        assert self._way is not None
        length_m = float(np.hypot(*np.diff(self._way[:, :2], axis=0).T).sum())
        why = found.reason if isinstance(found, NoCommand) else "the robot gets nowhere"
        return f"{why}; {length_m:.2f} m in straight pieces and turns on the spot lead on"

    def _forget(self) -> None:
        self._way = None
        self._refusals = self._in_a_row = 0
        self._still_s = self._no_nearer_s = 0.0
        self._still: Pose | None = None
        self._left_m = self._nearest_m = math.inf

    def _is_stuck(self, state: RobotState, found: Command | NoCommand) -> bool:
        """Tell whether the controller has found nothing some times, or drives without effect."""
        assert self._plan is not None
        still = self._still
        moved = still is None or math.dist(still[:2], state.pose[:2]) > _NOWHERE_M
        if moved or (still and abs(angle_between(still[2], state.pose[2])) > _NOWHERE_RAD):
            self._still_s = 0.0
            self._still = state.pose
        self._still_s += self._period_s
        self._no_nearer_s += self._period_s
        self._plan.advance(state.pose, _SEARCH_M)
        left_m = self._plan.remaining_m()
        if not self._nearest_m - _NEARER_M <= left_m <= self._nearest_m + _LONGER_M:
            self._nearest_m, self._no_nearer_s = left_m, 0.0
        self._refusals = self._refusals + 1 if isinstance(found, NoCommand) else 0
        if self._refusals >= _REFUSALS:
            return True
        near = math.dist(self._plan.goal[:2], state.pose[:2]) <= _IN_GOAL_M
        return (self._still_s > _NOWHERE_S or self._no_nearer_s > _NO_NEARER_S) and not near

    def _find(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> NDArray[np.float64] | None:
        assert self._plan is not None
        self._plan.advance(state.pose, _SEARCH_M)
        left_m = self._plan.remaining_m()
        # What has brought the robot no further some times does not the next time.
        self._in_a_row = self._in_a_row + 1 if left_m > self._left_m - 0.3 else 0
        self._left_m = min(left_m, self._left_m)
        if self._in_a_row >= _MAX_IN_A_ROW:
            return None
        free = [s for s in _SCALES if _is_free(grid, footprint, state.pose, s)]
        if not free:
            return None
        self._scale = free[0]
        for ahead_m in _AHEAD_M:
            target = self._plan.ahead(ahead_m)
            way = _search(grid, footprint, state.pose, target, self._scale)
            if len(way) > 1:
                return way
        return None

    def _drive(self, state: RobotState, grid: CostGrid, footprint: Footprint) -> Command | None:
        """Return the next velocity of a maneuver; None when it is over or cannot go on."""
        way = self._way
        assert way is not None
        while self._at < len(way) and self._has_passed(state, way):
            self._at += 1
        if self._at >= len(way):
            return None
        coming = way[self._at : self._at + _LOOK_AHEAD]
        if not all(_is_free(grid, footprint, tuple(pose), self._scale) for pose in coming):
            return None
        velocity = self._velocity(state, way)
        return None if velocity is None else Command(velocity, way[self._at - 1 :])

    def _has_passed(self, state: RobotState, way: NDArray[np.float64]) -> bool:
        before, after = way[self._at - 1], way[self._at]
        x, y, yaw = state.pose
        if _is_turn(before, after):
            return abs(angle_between(yaw, after[2])) <= _ON_THE_WAY_RAD
        along = (after[:2] - before[:2]) / np.hypot(*(after[:2] - before[:2]))
        return bool((after[0] - x) * along[0] + (after[1] - y) * along[1] <= 0.01)

    def _velocity(self, state: RobotState, way: NDArray[np.float64]) -> Velocity | None:
        before, after = way[self._at - 1], way[self._at]
        x, y, yaw = state.pose
        pace = self._pace
        if _is_turn(before, after):
            turn = angle_between(yaw, way[self._last_of_its_kind(way)][2])
            speed = max(min(pace.rad_s, math.sqrt(2 * abs(turn))), pace.slowest_rad_s)
            return 0.0, 0.0, math.copysign(speed, turn)
        heading = after[2]
        aside = -math.sin(heading) * (x - after[0]) + math.cos(heading) * (y - after[1])
        if abs(aside) > _ASTRAY_M:
            return None
        sign = 1.0 if math.cos(heading) * (after[0] - before[0]) + math.sin(heading) * (
            after[1] - before[1]
        ) > 0 else -1.0  # fmt: skip
        end = way[self._last_of_its_kind(way)]
        left_m = math.dist(end[:2], (x, y))
        speed = min(pace.m_s, self._limit_m_s, max(math.sqrt(2 * pace.m_s2 * left_m) / 2, 0.03))
        turn = angle_between(yaw, heading)
        rate = 2.0 * turn - sign * 3.0 * aside
        return sign * speed, 0.0, min(max(rate, -pace.rad_s), pace.rad_s)

    def _last_of_its_kind(self, way: NDArray[np.float64]) -> int:
        """Return where the turn or the straight piece ends that the robot is on."""
        kind, k = _kind(way[self._at - 1], way[self._at]), self._at
        while k + 1 < len(way) and _kind(way[k], way[k + 1]) == kind:
            k += 1
        return k

    def _leave(self, state: RobotState) -> None:
        """Let the controller go on, from here."""
        self._way = None
        self._begin_anew(state)

    def _begin_anew(self, state: RobotState) -> None:
        self._refusals, self._still, self._still_s, self._no_nearer_s = 0, state.pose, 0.0, 0.0


def _kind(a: NDArray[np.float64], b: NDArray[np.float64]) -> int:
    """Return ±1 for straight ahead and back, ±2 for turns to the left and to the right."""
    if _is_turn(a, b):
        return 2 if angle_between(a[2], b[2]) > 0 else -2
    ahead = math.cos(b[2]) * (b[0] - a[0]) + math.sin(b[2]) * (b[1] - a[1])
    return 1 if ahead > 0 else -1


def _is_turn(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    return bool(np.hypot(*(b[:2] - a[:2])) < _ON_THE_WAY_M)


def _is_free(grid: CostGrid, footprint: Footprint, pose: Pose, scale: float) -> bool:
    smaller = Footprint(tuple((x * scale, y * scale) for x, y in footprint.corners))
    return footprint_cost(grid, smaller if scale < 1.0 else footprint, pose) >= 0


def _search(
    grid: CostGrid, footprint: Footprint, start: Pose, target: Pose, scale: float
) -> NDArray[np.float64]:
    from gazelle.navigation.controllers.escape_maneuver_kernels import find_maneuver

    outline = Outline(
        footprint.points,
        float(footprint.inscribed_m * scale),
        float(footprint.circumscribed_m * scale),
        float(scale),
    )
    return np.asarray(
        find_maneuver(grid.cells, outline, np.array(start), np.array(target), _NEAR_M)
    )
