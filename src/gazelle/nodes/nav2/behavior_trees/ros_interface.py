"""What the nodes of a tree need of ROS: robot, time, actions, services, topics, messages."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple, Protocol

from gazelle.interfaces.poses import pose_of

__all__ = [
    "Call",
    "Pose2",
    "RosInterface",
    "distance_m",
    "goals_of",
    "path_length_m",
    "plane_pose",
    "poses_of",
]


class Pose2(NamedTuple):
    """A pose in the plane: metres and radians."""

    x_m: float
    y_m: float
    yaw_rad: float


class Call(Protocol):
    """An action's goal or a service's request under way."""

    @property
    def is_done(self) -> bool:
        """True when there is a result, or will be none."""
        ...

    @property
    def succeeded(self) -> bool:
        """True when it ended well."""
        ...

    @property
    def result(self) -> Any:
        """The result message, None without one."""
        ...

    @property
    def feedback(self) -> Any:
        """The last feedback message, None before the first."""
        ...

    @property
    def why(self) -> str:
        """Why it failed, in words."""
        ...

    def cancel(self) -> None:
        """Ask for its end."""
        ...


class RosInterface(Protocol):
    """Robot, time, actions, services and topics."""

    def now_ns(self) -> int:
        """Tell the time."""
        ...

    def pose(self, global_frame: str = "", base_frame: str = "") -> Pose2 | None:
        """Return where the robot is, in the navigator's frames by default; None if unknown."""
        ...

    def can_transform(self, parent: str, child: str) -> bool:
        """Tell whether tf connects two frames."""
        ...

    def in_frame(self, pose: Any, frame: str = "") -> Any:
        """Return a ``PoseStamped`` in a frame, the global one by default; None if tf fails."""
        ...

    def speed_m_s(self) -> float:
        """Return how fast the robot drives, from odometry."""
        ...

    def action(self, name: str, kind: str, goal: Any) -> Call:
        """Send a goal."""
        ...

    def cancel_all(self, name: str, kind: str) -> None:
        """Cancel all goals of an action."""
        ...

    def service(self, name: str, kind: str, request: Any) -> Call:
        """Call a service."""
        ...

    def latest(self, topic: str, kind: str, *, latched: bool = False) -> Any:
        """Return a topic's last message, None before the first."""
        ...

    def message(self, kind: str) -> Any:
        """Return a message class."""
        ...

    def log(self, level: str, text: str) -> None:
        """Say something."""
        ...


def poses_of(path: Any) -> list[Any]:
    """Return the ``PoseStamped`` of a ``nav_msgs/Path``."""
    return list(path.poses)


def goals_of(goals: Any) -> list[Any]:
    """Return the poses of a list, or of a ``nav_msgs/Goals``."""
    return list(goals.goals) if hasattr(goals, "goals") else list(goals or ())


def plane_pose(pose: Any) -> Pose2:
    """Return a ``geometry_msgs/Pose`` in the plane."""
    return Pose2(*pose_of(pose).xy_yaw)


def distance_m(first: Any, second: Any) -> float:
    """Return the distance of two ``geometry_msgs/Pose`` in the plane."""
    return math.hypot(first.position.x - second.position.x, first.position.y - second.position.y)


def path_length_m(path: Any) -> float:
    """Return the length of a ``nav_msgs/Path``."""
    poses = poses_of(path)
    return sum(distance_m(one.pose, other.pose) for one, other in pairwise(poses))
