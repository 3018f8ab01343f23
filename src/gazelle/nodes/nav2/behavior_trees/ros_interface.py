"""What the nodes of a tree need of the world outside."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

__all__ = ["Call", "Pose2", "World"]


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


class World(Protocol):
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
