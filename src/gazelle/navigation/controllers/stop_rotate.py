"""The last of the way: standing still in the goal, and turning where it looks."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from gazelle.navigation.controllers.controller import NoCommand, RobotState, Velocity
from gazelle.navigation.controllers.followed_plan import angle_between

__all__ = ["Arrival"]

Pose = tuple[float, float, float]


@dataclass
class Arrival:
    """Stops and turns in the goal, as ``LatchedStopRotateController`` of base_local_planner.

    Attributes:
        tolerance_m, tolerance_rad: of the goal.
        stopped_m_s, stopped_rad_s: below them the robot stands.
        latches: once in the goal the robot only turns.
        deceleration: along x, y (m/s²) and around z (rad/s²), positive.
        acceleration_rad_s2: of turns.
        slowest_rad_s, fastest_rad_s: of turns.
        period_s: between two velocity commands.
    """

    tolerance_m: float
    tolerance_rad: float
    stopped_m_s: float
    stopped_rad_s: float
    latches: bool
    deceleration: tuple[float, float, float]
    acceleration_rad_s2: float
    slowest_rad_s: float
    fastest_rad_s: float
    period_s: float
    _latched: bool = field(default=False, init=False)
    _turning: bool = field(default=False, init=False)

    def reset(self) -> None:
        """Begin with another goal."""
        self._latched = self._turning = False

    def is_in_place(self, state: RobotState, goal: Pose) -> bool:
        """Tell whether the robot's place is the goal's, whichever way it looks."""
        away = math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1])
        near = away <= self.tolerance_m
        self._latched = self.latches and (near or self._latched)
        return near or self._latched

    def is_reached(self, state: RobotState, goal: Pose) -> bool:
        """Tell whether the robot stands in the goal, looking the right way."""
        if not self.is_in_place(state, goal):
            return False
        turn = angle_between(state.pose[2], goal[2])
        return abs(turn) <= self.tolerance_rad and self._stands(state)

    def leave(self) -> None:
        """Take in that the robot is not in the goal."""
        self._turning = False

    def velocity(
        self, state: RobotState, goal: Pose, hits: Callable[[Velocity], bool]
    ) -> Velocity | NoCommand:
        """Return how to stand still and then turn into the goal's direction.

        Args:
            state: of a robot whose place is the goal's.
            goal: the last pose of the path.
            hits: tells whether driving so would hit something; not asked about standing still.
        """
        turn = angle_between(state.pose[2], goal[2])
        if abs(turn) <= self.tolerance_rad:
            self._turning = False
            return 0.0, 0.0, 0.0
        if not self._turning and not self._stands(state):
            velocity, what = self._slower(state), "Stopping cmd in collision"
        else:
            self._turning = True
            velocity, what = (0.0, 0.0, self._turn(state, turn)), "Rotation cmd in collision"
        return NoCommand(what) if any(velocity) and hits(velocity) else velocity

    def _stands(self, state: RobotState) -> bool:
        speed = math.hypot(state.velocity[0], state.velocity[1])
        return speed <= self.stopped_m_s and abs(state.velocity[2]) <= self.stopped_rad_s

    def _slower(self, state: RobotState) -> Velocity:
        x, y, turn = (
            math.copysign(max(0.0, abs(v) - limit * self.period_s), v)
            for v, limit in zip(state.velocity, self.deceleration, strict=True)
        )
        return x, y, turn

    def _turn(self, state: RobotState, turn: float) -> float:
        """Return the turning velocity towards a direction, slow enough to stop there."""
        reach = self.acceleration_rad_s2 * self.period_s
        now, slowest, fastest = abs(state.velocity[2]), self.slowest_rad_s, self.fastest_rad_s
        speed = min(fastest, max(slowest, abs(turn)))
        speed = min(max(speed, now - reach), now + reach)
        speed = min(speed, math.sqrt(2 * self.acceleration_rad_s2 * abs(turn)))
        return math.copysign(min(fastest, max(slowest, speed)), turn)
