"""The updater: runs a node's tasks and publishes their statuses on ``/diagnostics``."""

from __future__ import annotations

from typing import Any

from gazelle.compat.diagnostic_updater.tasks import (
    IS_ROS1,
    DiagnosticArray,
    DiagnosticStatus,
    DiagnosticStatusWrapper,
    DiagnosticTaskVector,
)

__all__ = ["Updater"]

_TOPIC = "/diagnostics"
_RECHECK_S = 0.25
_NO_HARDWARE = (
    "diagnostic_updater: No HW_ID was set. This is probably a bug: call setHardwareID, with"
    " 'none' for a device that has no ID"
)


class _RospyNode:
    """What the updater needs of a node of rospy."""

    period_s: float = 1.0

    def __init__(self) -> None:
        from gazelle.compat import rospy

        self._rospy = rospy
        self._publisher = rospy.Publisher(_TOPIC, DiagnosticArray, queue_size=10)
        self._last = self._checked = rospy.Time.now()

    def name(self) -> str:
        return str(self._rospy.get_name()).removeprefix("/")

    def publish(self, array: Any) -> None:
        array.header.stamp = self._rospy.Time.now()
        self._publisher.publish(array)

    def warn(self, text: str) -> None:
        from gazelle.compat.rospy.log import logwarn

        logwarn(text)

    def note(self) -> None:
        """Count the period from now."""
        self._last = self._rospy.Time.now()

    def is_due(self) -> bool:
        """Tell whether the period is over; ``~diagnostic_period`` is read again now and then."""
        now = self._rospy.Time.now()
        if now >= self._checked + self._rospy.Duration(_RECHECK_S):
            self.period_s = float(self._rospy.get_param("~diagnostic_period", 1))
            self._checked = now
        return bool(now >= self._last + self._rospy.Duration(self.period_s))


class _RclpyNode:
    """What the updater needs of a node of rclpy."""

    def __init__(self, node: Any, period_s: float, updater: Updater) -> None:
        self._node = node
        self._updater = updater
        self._publisher = node.create_publisher(DiagnosticArray, _TOPIC, 1)
        self.period_s: float = node.declare_parameter("diagnostic_updater.period", period_s).value
        self._timer = node.create_timer(self.period_s, updater.update)
        key = "diagnostic_updater.use_fqn"
        if node.has_parameter(key):
            self._is_full = node.get_parameter(key).value
        else:
            self._is_full = node.declare_parameter(key, False).value

    def set_period(self, period_s: float) -> None:
        self.period_s = period_s
        self._node.destroy_timer(self._timer)
        self._timer = self._node.create_timer(period_s, self._updater.update)

    def name(self) -> str:
        name = self._node.get_name()
        return f"{self._node.get_namespace()}/{name}" if self._is_full else str(name)

    def publish(self, array: Any) -> None:
        array.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(array)

    def warn(self, text: str) -> None:
        self._node.get_logger().warning(text)

    def note(self) -> None:
        """The timer counts by itself."""

    def is_due(self) -> bool:
        return True


class Updater(DiagnosticTaskVector):
    """Runs tasks and publishes their statuses.

    With rospy the program calls `update` often, and once a ``~diagnostic_period`` it does
    something; with rclpy a timer of the node does it.

    Args:
        node: the node of rclpy; rospy has one.
        period: how often, in seconds, with rclpy.

    Attributes:
        verbose: tell every status that is not OK in the log.
        hwid: the device's identity.
    """

    def __init__(self, node: Any = None, period: float = 1.0) -> None:
        super().__init__()
        if node is None and not IS_ROS1:
            raise TypeError("Updater.__init__() missing 1 required positional argument: 'node'")
        self.node = node
        self.verbose = False
        self.hwid = ""
        self.warn_nohwid_done = False
        self._of: Any = _RospyNode() if node is None else _RclpyNode(node, period, self)

    @property
    def period(self) -> float:
        """How often the tasks run, in seconds."""
        return float(self._of.period_s)

    @period.setter
    def period(self, period: float) -> None:
        if isinstance(self._of, _RclpyNode):
            self._of.set_period(period)
        else:
            self._of.period_s = period

    def update(self) -> None:
        """Run the tasks and publish their statuses, if the period is over."""
        if self._of.is_due():
            self.force_update()

    def force_update(self) -> None:
        """Run the tasks and publish their statuses now."""
        self._of.note()
        found = []
        with self.lock:
            for task in self.tasks:
                status = DiagnosticStatusWrapper()
                status.name, status.hardware_id = task.name, self.hwid
                status.summary(DiagnosticStatus.ERROR, "No message was set")
                found.append(task.run(status))
        wrong = [status for status in found if status.level != DiagnosticStatus.OK]
        for status in wrong if self.verbose else ():
            level, told = status.level, f"'{status.message}'"
            self._of.warn(f"Non-zero diagnostic status. Name: '{status.name}', {level!r}: {told}")
        if not self.hwid and not wrong and not self.warn_nohwid_done:
            self._of.warn(_NO_HARDWARE)
            self.warn_nohwid_done = True
        self.publish(found)

    def broadcast(self, lvl: Any, msg: str) -> None:
        """Publish one level and message for every task."""
        found = []
        for task in self.tasks:
            status = DiagnosticStatusWrapper()
            status.name = task.name
            status.summary(lvl, msg)
            found.append(status)
        self.publish(found)

    def setHardwareID(self, hwid: str) -> None:
        """Say which device the statuses are of."""
        self.hwid = hwid

    def publish(self, msg: Any) -> None:
        """Publish one status or several, under the node's name."""
        array = DiagnosticArray()
        for status in msg if isinstance(msg, list) else [msg]:
            plain = DiagnosticStatus()
            plain.level, plain.message = status.level, status.message
            plain.hardware_id, plain.values = status.hardware_id, status.values
            plain.name = f"{self._of.name()}: {status.name}"
            array.status.append(plain)
        self._of.publish(array)

    def addedTaskCallback(self, task: Any) -> None:
        """Publish that a task is there."""
        status = DiagnosticStatusWrapper()
        status.name = task.name
        status.summary(DiagnosticStatus.OK, "Node starting up")
        self.publish(status)
