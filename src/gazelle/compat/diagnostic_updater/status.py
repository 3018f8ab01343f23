"""``diagnostic_msgs/DiagnosticStatus`` with methods that fill it, in the program's own form."""

from __future__ import annotations

from typing import Any

from gazelle.compat.ros_version import message_ros_version
from gazelle.interfaces import message_type, ros1_message_type

__all__ = ["IS_ROS1", "DiagnosticArray", "DiagnosticStatus", "DiagnosticStatusWrapper", "seconds"]

IS_ROS1 = message_ros_version() == 1
_make: Any = ros1_message_type if IS_ROS1 else message_type
DiagnosticArray: Any = _make("diagnostic_msgs/DiagnosticArray")
DiagnosticStatus: Any = _make("diagnostic_msgs/DiagnosticStatus")
_KeyValue: Any = _make("diagnostic_msgs/KeyValue")


class DiagnosticStatusWrapper(DiagnosticStatus):  # type: ignore[misc]
    """A status that tasks fill in."""

    def summary(self, *args: Any) -> None:
        """Set level and message: of another status, or a level and a message."""
        self.level, self.message = _summary(args)

    def clearSummary(self) -> None:
        """Set the level to OK and the message to nothing."""
        self.summary(DiagnosticStatus.OK, "")

    def mergeSummary(self, *args: Any) -> None:
        """Take the worse of two levels, and the messages of those that are not OK.

        Args:
            args: another status, or a level and a message.
        """
        level, message = _summary(args)
        ok = DiagnosticStatus.OK
        if (level > ok) == (self.level > ok):
            self.message = "; ".join(filter(None, (self.message, message)))
        elif level > self.level:
            self.message = message
        self.level = max(level, self.level)

    def add(self, key: str, val: object) -> None:
        """Append a value; anything is written as text."""
        self.values.append(_KeyValue(key=key, value=str(val)))


def _summary(args: tuple[Any, ...]) -> tuple[Any, str]:
    """Return level and message."""
    if len(args) == 1:
        return args[0].level, args[0].message
    level, message = args
    return level, str(message)


def seconds() -> float:
    """Return the time that rates and stamps are measured with."""
    if IS_ROS1:
        from gazelle.compat.rospy import Time

        return float(Time.now().to_sec())
    from gazelle.compat.rclpy.clock import Clock
    from gazelle.compat.rclpy.time import ClockType

    return Clock(clock_type=ClockType.ROS_TIME).now().nanoseconds * 1e-9
