"""Where the simulator has put the robot, as a hint for who forgot the initial pose."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

from gazelle.graph.gazebo_names import world_names
from gazelle.interfaces.poses import unit_pose_of
from gazelle.nodes.navigation.robot_pose import PlanePose

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["SpawnHint"]

_FAR_M, _FAR_RAD = 0.3, math.radians(20)


class SpawnHint:
    """Tells once where a simulated robot stands when that is not where amcl begins."""

    def __init__(self, node: Node, begins: PlanePose, *, is_ros2: bool) -> None:
        """Listen to the simulator, if there is one."""
        self._node, self._begins = node, begins
        shown, hidden = world_names("/gazebo/model_states")
        self._subscriptions: list[Any] = []
        # Who listens to a name shows it, too.
        self._subscriptions = [
            node.create_subscription(
                topic, "gazebo_msgs/msg/ModelStates", self._on_states, queue_size=1
            )
            for topic in ((hidden,) if is_ros2 else (shown, hidden))
        ]

    def close(self) -> None:
        """Listen no more."""
        subscriptions, self._subscriptions = self._subscriptions, []
        for subscription in subscriptions:
            subscription.unregister()

    def _on_states(self, message: Any) -> None:
        index = self._robot(list(message.name))
        if not self._subscriptions or index is None:
            return
        self.close()
        x, y, yaw = unit_pose_of(message.pose[index]).xy_yaw
        bx, by, byaw = self._begins
        turn = abs(math.remainder(yaw - byaw, math.tau))
        if math.hypot(x - bx, y - by) < _FAR_M and turn < _FAR_RAD:
            return
        self._node.log(
            "warn",
            f"nobody gave an initial pose, so amcl begins at ({bx:.2f}, {by:.2f}, {byaw:.2f}); the "
            f"simulator has '{message.name[index]}' at ({x:.2f}, {y:.2f}, {yaw:.2f}). If the map's "
            "frame is the world's: set the parameters initial_pose_x, initial_pose_y and "
            "initial_pose_a to that, or give it with RViz's 2D Pose Estimate",
        )

    def _robot(self, names: list[str]) -> int | None:
        """Return which model is the robot: the one the description names, if there is one."""
        text = str(self._node.parameters.get("/robot_description", "") or "")
        found = re.search(r"<robot\b[^>]*\bname\s*=\s*[\"']([^\"']+)", text)
        if found and found[1] in names:
            return names.index(found[1])
        return None
