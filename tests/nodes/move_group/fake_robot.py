"""A robot that goes where trajectories end, with controllers that can be told to misbehave."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.graph import Node
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type

_FOLLOW = "control_msgs/FollowJointTrajectory"
_GRIPPER = "control_msgs/GripperCommand"


class FakeRobot:
    """Publishes joint states and serves ``follow_joint_trajectory`` and ``gripper_cmd``.

    Attributes:
        positions: where the joints are.
        goals: the goals that came, by controller.
    """

    def __init__(self, node: Node, positions: dict[str, float], ros_version: int = 2) -> None:
        self._ros_version = ros_version
        self.positions = dict(positions)
        self.goals: dict[str, list[Any]] = {}
        self.servers: list[ActionServer] = []
        self._node = node
        # Who is at work on a goal when a test ends may still publish.
        node.outlives = True
        self._out = node.create_publisher("/joint_states", "sensor_msgs/msg/JointState")

    def publish(self) -> None:
        """Tell where the joints are."""
        message: Any = message_type("sensor_msgs/msg/JointState")()
        now_ns = self._node.clock.now_ns()
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(now_ns, 10**9)
        message.name = list(self.positions)
        message.position = list(self.positions.values())
        self._out.publish(message)

    def follow(self, name: str, end: Callable[[ServerGoal], None] | None = None) -> None:
        """Serve a controller of trajectories; `end` says what becomes of a goal."""

        def arrive(goal: ServerGoal) -> None:
            trajectory = goal.request.trajectory
            last = trajectory.points[-1].positions
            self.positions.update(zip(trajectory.joint_names, map(float, last), strict=True))
            self.publish()
            goal.succeed()

        self._serve(f"/{name}/follow_joint_trajectory", _FOLLOW, name, end or arrive)

    def gripper(self, name: str, end: Callable[[ServerGoal], None]) -> None:
        """Serve a gripper."""
        self._serve(f"/{name}/gripper_cmd", _GRIPPER, name, end)

    def _serve(self, action: str, kind: str, name: str, end: Callable[[ServerGoal], None]) -> None:
        def on_goal(goal: ServerGoal) -> None:
            self.goals.setdefault(name, []).append(goal.request)
            goal.accept()
            threading.Thread(target=end, args=(goal,), daemon=True).start()

        server = ActionServer(
            self._node,
            action,
            kind,
            on_goal=on_goal,
            on_cancel=_cancel,
            ros_version=1 if self._ros_version == 1 else 2,
        )
        self.servers.append(server)


def _cancel(goal: ServerGoal) -> bool:
    goal.cancel()
    return True


def trajectory(joints: list[str], *rows: list[float], seconds: float = 0.2) -> Any:
    """Return a ``JointTrajectory`` with rows at equal times."""
    made: Any = message_type("trajectory_msgs/msg/JointTrajectory")(joint_names=joints)
    point = message_type("trajectory_msgs/msg/JointTrajectoryPoint")
    for number, row in enumerate(rows):
        at_ns = round(seconds * 1e9 * number / max(1, len(rows) - 1))
        item: Any = point(positions=row)
        item.time_from_start.sec, item.time_from_start.nanosec = divmod(at_ns, 10**9)
        made.points.append(item)
    return made
