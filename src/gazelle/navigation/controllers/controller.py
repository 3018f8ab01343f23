"""What a controller is given, and what it gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.rollout_arguments import PlanarState
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.costmap.footprint import Footprint

__all__ = ["Command", "Controller", "NoCommand", "RobotState", "Velocity"]

Pose = tuple[float, float, float]
Velocity = tuple[float, float, float]
"""Along x and y of the robot (m/s) and around z (rad/s)."""


@dataclass(frozen=True, slots=True)
class RobotState:
    """Where a robot is and how it moves.

    Attributes:
        pose: in the frame of the local costmap.
        velocity: in its own frame, as odometry says.
    """

    pose: Pose
    velocity: Velocity = (0.0, 0.0, 0.0)

    @property
    def planar(self) -> PlanarState:
        """What kernels take of it."""
        return PlanarState(*map(float, self.pose), *map(float, self.velocity))


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """A velocity to drive with.

    Attributes:
        velocity: along x and y of the robot (m/s) and around z (rad/s).
        trajectory: where that leads, (n, 3) poses.
        cost: of the controller's own measure.
        note: what is to be said about it, mostly nothing.
    """

    velocity: Velocity
    trajectory: NDArray[np.float64]
    cost: float = 0.0
    note: str = ""


@dataclass(frozen=True, slots=True)
class NoCommand:
    """There is no velocity to drive with; the robot has to stop.

    Attributes:
        reason: in words.
    """

    reason: str


class Controller(Protocol):
    """Follows a path. One object follows one robot."""

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path.

        Args:
            plan: (n, 3) poses in the frame of the local costmap, the last one the goal.
            has_moved: it is the path of before in a frame that has drifted, so that what was
                driven along it still counts.
        """

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity."""

    def goal_reached(self, state: RobotState) -> bool:
        """Tell whether the robot stands in the goal, by the controller's own tolerances."""

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this; None for the options' own speed."""

    def reset(self) -> None:
        """Forget what was driven before."""
