"""Whether a robot is at its goal, and whether it gets on: Nav2's checkers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gazelle.nodes.navigation.robot_pose import PlanePose
from gazelle.parameters.reader import ParameterReader

__all__ = ["GoalChecker", "ProgressChecker", "goal_checker", "progress_checker"]

_NANO = 1e9


@dataclass(slots=True)
class GoalChecker:
    """In place and direction, and standing where that is asked for.

    Attributes:
        xy_m, yaw_rad: tolerances.
        stateful: once in place only the direction counts.
        stopped: fastest that counts as standing, m/s and rad/s.
    """

    xy_m: float
    yaw_rad: float
    stateful: bool
    stopped: tuple[float, float]
    _in_place: bool = False

    def reset(self) -> None:
        """Begin with a new goal."""
        self._in_place = False

    def is_reached(
        self, pose: PlanePose, goal: PlanePose, velocity: tuple[float, float, float]
    ) -> bool:
        """Tell whether the goal is reached."""
        away = math.hypot(pose[0] - goal[0], pose[1] - goal[1])
        if not (self.stateful and self._in_place):
            if away > self.xy_m:
                return False
            self._in_place = True
        if abs(math.remainder(pose[2] - goal[2], math.tau)) > self.yaw_rad:
            return False
        speed = math.hypot(velocity[0], velocity[1])
        return speed <= self.stopped[0] and abs(velocity[2]) <= self.stopped[1]


@dataclass(slots=True)
class ProgressChecker:
    """Whether the robot gets away from where it was.

    Attributes:
        radius_m, angle_rad: how far it has to get, or to turn; infinite for not by turning.
        allowance_s: within this time.
    """

    radius_m: float
    angle_rad: float
    allowance_s: float
    now_ns: Callable[[], int]
    _base: PlanePose | None = None
    _since_ns: int = 0

    def reset(self) -> None:
        """Begin to count."""
        self._base = None

    def gets_on(self, pose: PlanePose) -> bool:
        """Tell whether it does."""
        now_ns = self.now_ns()
        base = self._base
        moved = math.inf if base is None else math.hypot(pose[0] - base[0], pose[1] - base[1])
        turned = 0.0 if base is None else abs(math.remainder(pose[2] - base[2], math.tau))
        if moved > self.radius_m or turned > self.angle_rad or now_ns < self._since_ns:
            self._base, self._since_ns = pose, now_ns
            return True
        return (now_ns - self._since_ns) / _NANO <= self.allowance_s


def goal_checker(settings: ParameterReader) -> GoalChecker:
    """Make a goal checker of its settings."""
    known = {row.key for row in settings.table.rows}
    stopped = (math.inf, math.inf)
    if "trans_stopped_velocity" in known:
        stopped = (
            settings.number("trans_stopped_velocity"), settings.number("rot_stopped_velocity"),
        )  # fmt: skip
    number = settings.number
    return GoalChecker(
        number("xy_goal_tolerance"), number("yaw_goal_tolerance"), settings.flag("stateful"),
        stopped,
    )  # fmt: skip


def progress_checker(settings: ParameterReader, now_ns: Callable[[], int]) -> ProgressChecker:
    """Make a progress checker of its settings."""
    known = {row.key for row in settings.table.rows}
    turns = "required_movement_angle" in known
    return ProgressChecker(
        settings.number("required_movement_radius"),
        settings.number("required_movement_angle") if turns else math.inf,
        settings.number("movement_time_allowance"),
        now_ns,
    )
