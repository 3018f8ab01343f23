"""Actions and services of one node, asked one at a time and waited for."""

from __future__ import annotations

from typing import Any

from gazelle.compat import rclpy
from gazelle.compat.rclpy.action import ActionClient
from gazelle.compat.rclpy.node import Node
from gazelle.compat.rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from gazelle.interfaces import action_type, message_type, service_type

__all__ = ["NavigatorCalls"]

_SLICE_S = 0.1
_SERVICE_S = 1.0


class NavigatorCalls(Node):
    """A node with one action's goal under way.

    Attributes:
        goal_handle: of the task.
        result_future: its end.
        feedback: the last one.
        status: number of ``action_msgs/GoalStatus`` at the end, None before.
        initial_pose_received: localisation has told a pose.
    """

    def __init__(self, node_name: str, namespace: str) -> None:
        super().__init__(node_name, namespace=namespace)
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        self.initial_pose_received = False
        self._action_clients: dict[str, Any] = {}
        self._service_clients: dict[str, Any] = {}
        latched = QoSProfile(
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
            reliability=ReliabilityPolicy.RELIABLE,
            history=HistoryPolicy.KEEP_LAST,
            depth=1,
        )
        pose = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
        self.create_subscription(pose, "amcl_pose", self._on_pose, latched)
        self.initial_pose_pub = self.create_publisher(pose, "initialpose", 10)

    def begin(self, name: str, kind: str, **fields: Any) -> Any:
        """Send a goal and wait until it is taken; false when it is not."""
        client = self._action(name, kind)
        while not client.wait_for_server(timeout_sec=1.0):
            self.info(f"'{name}' action server not available, waiting...")
        goal = _filled(action_type(f"nav2_msgs/action/{kind}").Goal(), fields)
        self.feedback = self.status = None
        future = client.send_goal_async(goal, self._on_feedback)
        rclpy.spin_until_future_complete(self, future)
        self.goal_handle = future.result()
        if self.goal_handle is None or not self.goal_handle.accepted:
            self.error(f"Goal of {name} was rejected!")
            self.goal_handle = self.result_future = None
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def cancelTask(self) -> None:
        """Ask for the end of the task."""
        self.info("Canceling current task.")
        if self.result_future is not None and self.goal_handle is not None:
            future = self.goal_handle.cancel_goal_async()
            rclpy.spin_until_future_complete(self, future)

    def isTaskComplete(self) -> bool:
        """Tell whether the task is over; waits for a tenth of a second."""
        if self.result_future is None:
            return True
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=_SLICE_S)
        found = self.result_future.result() if self.result_future.done() else None
        if found is None:
            return False
        self.status = int(found.status)
        if self.status != 4:
            self.debug(f"Task with failed status code: {self.status}")
        return True

    def getFeedback(self) -> Any:
        """Return the last feedback of the task, None before the first."""
        return self.feedback

    def ask_action(self, name: str, kind: str, **fields: Any) -> Any:
        """Send a goal and return its result, None when it failed."""
        if not self.begin(name, kind, **fields):
            return None
        while not self.isTaskComplete():
            pass
        found = self.result_future.result()
        if self.status != 4:
            why = getattr(found.result, "error_msg", "")
            self.warn(f"{name} failed with status code: {self.status}{f': {why}' if why else ''}")
            return None
        return found.result

    def ask(self, name: str, kind: str, **fields: Any) -> Any:
        """Call a service and return its response."""
        service = service_type(kind)
        if name not in self._service_clients:
            self._service_clients[name] = self.create_client(service, name)
        client = self._service_clients[name]
        while not client.wait_for_service(timeout_sec=_SERVICE_S):
            self.info(f"{name} service not available, waiting...")
        future = client.call_async(_filled(service.Request(), fields))
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def spin_once(self, timeout_s: float) -> None:
        """Let callbacks run."""
        rclpy.spin_once(self, timeout_sec=timeout_s)

    def destroyNode(self) -> None:
        """Take the node off the graph."""
        self.destroy_node()

    def destroy_node(self) -> None:
        """Take the node off the graph."""
        for client in self._action_clients.values():
            client.destroy()
        super().destroy_node()

    def info(self, msg: str) -> None:
        """Log."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Log."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Log."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Log."""
        self.get_logger().debug(msg)

    def _action(self, name: str, kind: str) -> Any:
        if name not in self._action_clients:
            made = action_type(f"nav2_msgs/action/{kind}")
            self._action_clients[name] = ActionClient(self, made, name)
        return self._action_clients[name]

    def _on_feedback(self, message: Any) -> None:
        self.feedback = message.feedback

    def _on_pose(self, _message: Any) -> None:
        self.debug("Received amcl pose")
        self.initial_pose_received = True


def _filled(message: Any, fields: dict[str, Any]) -> Any:
    for name, value in fields.items():
        if hasattr(message, name):
            held = getattr(message, name)
            if hasattr(held, "goals") and not hasattr(value, "goals"):
                held.goals = list(value)
            else:
                setattr(message, name, value)
    return message
