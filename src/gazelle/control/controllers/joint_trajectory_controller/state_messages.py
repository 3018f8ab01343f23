"""Messages of a trajectory controller: its state, feedback and results of goals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_node_interface import GoalPort, Ports, PublisherPort
from gazelle.control.interface_values import Array
from gazelle.control.trajectory.waypoints import ErrorCode
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp, stamped

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Feedback", "StateReport", "point", "result", "violation"]

_NANO = 1_000_000_000
_STATE = "control_msgs/JointTrajectoryControllerState"
_FEEDBACK = "control_msgs/FollowJointTrajectoryFeedback"


def point(rows: Iterable[Array | None], time_ns: int, effort: Array | None = None) -> Any:
    """Return a JointTrajectoryPoint of positions, velocities and accelerations; copies them.

    Args:
        rows: (N,) each, up to three of them; None for a field that stays empty.
        time_ns: ``time_from_start``.
        effort: (N,), N·m, or N of joints that slide.
    """
    message = message_type("trajectory_msgs/JointTrajectoryPoint")()
    fields = ("positions", "velocities", "accelerations")
    for name, values in zip(fields, rows, strict=False):
        if values is not None:
            setattr(message, name, values.copy())
    if effort is not None:
        message.effort = effort.copy()
    set_stamp(message.time_from_start, time_ns)
    return message


def result(code: ErrorCode, text: str = "") -> dict[str, Any]:
    """Return a result of FollowJointTrajectory."""
    return {"error_code": int(code), "error_string": text}


def violation(error: Array, limits: Array) -> str:
    """Return what exceeds its limit: position, velocity and acceleration of one joint, (3,)."""
    quantities = ("Position", "Velocity", "Acceleration")
    return "; ".join(
        f"{word} Error: {value:f}, {word} Tolerance: {limit:f}"
        for word, value, limit in zip(quantities, error, limits, strict=True)
        if abs(value) > limit
    )


class StateReport:
    """Publishes the state at a rate, when somebody listens.

    Attributes:
        period_ns: time between two messages, 0 for never.
    """

    def __init__(
        self, ports: Ports, topics: Sequence[str], names: Sequence[str], rate_hz: float
    ) -> None:
        self._publishers: list[PublisherPort] = [ports.publisher(t, _STATE) for t in topics]
        self._names = list(names)
        self.period_ns = round(_NANO / rate_hz) if rate_hz > 0.0 else 0
        self._next_ns = 0

    def start(self, time_ns: int) -> None:
        """Count from now on."""
        self._next_ns = time_ns + self.period_ns

    def is_due(self, time_ns: int) -> bool:
        """Tell whether a message is due and wanted; cheap."""
        if time_ns < self._next_ns or not self.period_ns:
            return False
        self._next_ns += self.period_ns * ((time_ns - self._next_ns) // self.period_ns + 1)
        return any(publisher.matched for publisher in self._publishers)

    def publish(
        self,
        time_ns: int,
        desired: Any,
        actual: Any,
        error: Any,
        output: Any = None,
        *,
        scaling: float = 1.0,
    ) -> None:
        """Send a message of up to four points; `scaling` is how fast trajectories run."""
        message = stamped(_STATE, time_ns)
        message.joint_names = list(self._names)
        message.reference, message.feedback, message.error = desired, actual, error
        message.speed_scaling_factor = scaling
        if output is not None:
            message.output = output
        for publisher in self._publishers:
            if publisher.matched:
                publisher.publish(message)


class Feedback:
    """Tells the clients of a goal how it goes, at ``action_monitor_rate``."""

    def __init__(self, names: Sequence[str], rate_hz: float) -> None:
        self._names = list(names)
        self._period_ns = round(_NANO / rate_hz) if rate_hz > 0.0 else 0
        self._next_ns = 0

    def start(self, time_ns: int) -> None:
        """Begin with a new goal."""
        self._next_ns = time_ns + self._period_ns

    def tell(
        self, goal: GoalPort, time_ns: int, points: Callable[[], tuple[Any, Any, Any]]
    ) -> None:
        """Send feedback when it is due and wanted; `points` gives desired, actual and error."""
        if time_ns < self._next_ns or not self._period_ns:
            return
        self._next_ns += self._period_ns * ((time_ns - self._next_ns) // self._period_ns + 1)
        if not goal.is_feedback_wanted:
            return
        message = stamped(_FEEDBACK, time_ns)
        message.joint_names = list(self._names)
        message.desired, message.actual, message.error = points()
        goal.publish_feedback(message)
