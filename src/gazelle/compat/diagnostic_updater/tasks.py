"""Tasks of a node's diagnostics, alone, together and in a list, and the statuses they fill in.

A status is a ``diagnostic_msgs/DiagnosticStatus`` in the program's own form, ROS 1's or ROS 2's.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.compat.ros_version import message_ros_version
from gazelle.interfaces import message_type, ros1_message_type

__all__ = [
    "IS_ROS1",
    "CompositeDiagnosticTask",
    "DiagnosticArray",
    "DiagnosticStatus",
    "DiagnosticStatusWrapper",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FunctionDiagnosticTask",
    "seconds",
]

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


def seconds() -> float:
    """Return the time that rates and stamps are measured with."""
    if IS_ROS1:
        from gazelle.compat.rospy import Time

        return float(Time.now().to_sec())
    from gazelle.compat.rclpy.clock import Clock
    from gazelle.compat.rclpy.time import ClockType

    return Clock(clock_type=ClockType.ROS_TIME).now().nanoseconds * 1e-9


class DiagnosticTask:
    """Something that is reported on; a program's own tasks have their own `run`."""

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        """Return the name."""
        return self.name

    def run(self, stat: Any) -> Any:
        """Fill in a status and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """A task that is a function of a status."""

    def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: Any) -> Any:
        """Let the function fill in a status."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Tasks with one status: the worst level, and the messages of what is not OK."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[Any] = []

    def addTask(self, t: Any) -> None:
        """Append a task."""
        self.tasks.append(t)

    def run(self, stat: Any) -> Any:
        """Let each task fill in the status."""
        combined, original = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        combined.clearSummary()
        original.summary(stat)
        for task in self.tasks:
            stat.summary(original)
            stat = task.run(stat)
            combined.mergeSummary(stat)
        stat.summary(combined)
        return stat


class DiagnosticTaskVector:
    """Tasks by name."""

    class DiagnosticTaskInternal:
        """A task of the list."""

        def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
            self.name = name
            self.fn = fn

        def run(self, stat: Any) -> Any:
            """Fill in a status."""
            stat.name = self.name
            return self.fn(stat)

    def __init__(self) -> None:
        self.tasks: list[DiagnosticTaskVector.DiagnosticTaskInternal] = []
        self.lock = threading.Lock()

    def addedTaskCallback(self, task: Any) -> None:
        """Follow up on a new task; classes say how."""

    def add(self, *args: Any) -> None:
        """Append a task, or a function under a name."""
        name, run = args if len(args) == 2 else (args[0].getName(), args[0].run)
        task = DiagnosticTaskVector.DiagnosticTaskInternal(name, run)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name: str) -> bool:
        """Remove the first task of a name; False if there is none."""
        with self.lock:
            found = next((task for task in self.tasks if task.name == name), None)
            if found is not None:
                self.tasks.remove(found)
        return found is not None


def _summary(args: tuple[Any, ...]) -> tuple[Any, str]:
    """Return level and message."""
    if len(args) == 1:
        return args[0].level, args[0].message
    level, message = args
    return level, str(message)
