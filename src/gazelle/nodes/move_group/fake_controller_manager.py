"""``moveit_fake_controller_manager``: controllers that only tell where the joints would be.

MoveIt 1's ``demo.launch`` has them. Joint states go to ``~fake_controller_joint_states``, which a
joint_state_publisher takes as its source; MoveIt gives them at 10 Hz.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from gazelle.description.moveit import ControllerEntry
from gazelle.graph import Node
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp
from gazelle.motion.model import RobotModel
from gazelle.nodes.move_group.simple_controller_manager import FAKE_TYPES, fake_action

__all__ = ["FakeControllers", "initial_positions"]

_FOLLOW = "control_msgs/FollowJointTrajectory"
_RATE_HZ = 10.0
_NANO = 1_000_000_000


class FakeControllers:
    """Serves the actions of all fake controllers of a configuration."""

    def __init__(
        self, node: Node, entries: Sequence[ControllerEntry], initial: Mapping[str, float]
    ) -> None:
        """Tell where the joints begin.

        Args:
            node: offers the actions and tells.
            entries: the controllers, others than fake ones too.
            initial: positions by joint.
        """
        self._node = node
        self._clock = node.clock
        self._out = node.create_publisher(
            "~fake_controller_joint_states", "sensor_msgs/msg/JointState", latch=True
        )
        self._servers = [
            ActionServer(
                node,
                fake_action(entry.name),
                _FOLLOW,
                on_goal=partial(self._on_goal, entry.type),
                on_cancel=lambda _goal: True,
                ros_version=1,
            )
            for entry in entries
            if entry.type in FAKE_TYPES
        ]
        if initial:
            self._tell(list(initial), list(initial.values()))

    def _on_goal(self, kind: str, goal: ServerGoal) -> None:
        goal.accept()
        threading.Thread(target=self._run, args=(goal, kind), daemon=True).start()

    def _run(self, goal: ServerGoal, kind: str) -> None:
        trajectory = goal.request.trajectory
        names, points = list(trajectory.joint_names), list(trajectory.points)
        ends_s = np.array([_seconds(point.time_from_start) for point in points])
        rows = np.array([point.positions for point in points])
        began_ns = self._clock.now_ns()
        for at_s in _moments(ends_s, kind):
            left_ns = began_ns + round(at_s * _NANO) - self._clock.now_ns()
            if left_ns > 0:
                self._clock.sleep(left_ns)
            if goal.is_cancel_requested:
                goal.cancel()
                return
            row = [float(np.interp(at_s, ends_s, column)) for column in rows.T]
            self._tell(names, row if kind != FAKE_TYPES[2] else rows[-1].tolist())
        goal.succeed()

    def _tell(self, names: list[str], positions: list[float]) -> None:
        message: Any = message_type("sensor_msgs/msg/JointState")(name=names, position=positions)
        now_ns = self._clock.now_ns()
        set_stamp(message.header.stamp, now_ns)
        self._out.publish(message)


def initial_positions(robot: RobotModel, parameters: Mapping[str, Any]) -> dict[str, float]:
    """Return the positions of the named states that ``initial`` lists, by joint."""
    found: dict[str, float] = {}
    listed = parameters.get("initial")
    for row in listed if isinstance(listed, list) else ():
        group = robot.groups.get(str(row.get("group", ""))) if isinstance(row, Mapping) else None
        if group is not None:
            found.update(group.states.get(str(row.get("pose", "")), {}))
    return found


def _moments(ends_s: Any, kind: str) -> list[float]:
    """Return when joint states are told, from the start."""
    last_s = float(ends_s[-1]) if len(ends_s) else 0.0
    if kind == FAKE_TYPES[0]:
        return [*np.arange(0.0, last_s, 1.0 / _RATE_HZ).tolist(), last_s]
    return [0.0] if kind == FAKE_TYPES[2] else [0.0, *ends_s[ends_s > 0.0].tolist()]


def _seconds(duration: Any) -> float:
    whole = getattr(duration, "sec", None)
    return float(duration.to_sec() if whole is None else whole + duration.nanosec / _NANO)
