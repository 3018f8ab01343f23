"""A client of move_group: its actions and services, in ROS 2's form of the messages."""

from __future__ import annotations

from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Node
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces import action_type, fill, service_type

__all__ = ["MoveGroupClient"]

_MOVE = action_type("moveit_msgs/MoveGroup")
_EXECUTE = action_type("moveit_msgs/ExecuteTrajectory")
_CALL_S = 60.0
_NAMES = ("move_group", "move_action")


class MoveGroupClient:
    """Talks to the move_group of one namespace, of ROS 1 or ROS 2."""

    def __init__(self, node: Node, namespace: str = "") -> None:
        """Prepare; nothing is waited for.

        Args:
            node: sends and calls.
            namespace: where move_group is, empty for the node's own.
        """
        self.node = node
        self._prefix = f"{namespace.rstrip('/')}/" if namespace else ""
        # ROS 1 and ROS 2 call the action differently; whichever there is will be used.
        self._movers = [ActionClient(node, self._name(name), _MOVE) for name in _NAMES]
        self._executor = ActionClient(node, self._name("execute_trajectory"), _EXECUTE)
        self._clients: dict[str, Any] = {}
        self._running: ClientGoal | None = None

    def wait(self, timeout_s: float) -> bool:
        """Wait until a move_group is there; tells whether one came."""
        return self._executor.wait_for_server(timeout_s) and self._mover() is not None

    def move(self, goal: Any, *, wait: bool = True) -> Any:
        """Send a ``MoveGroup`` goal; returns its result, None when it is not waited for.

        Raises:
            GazelleError: there is no move_group.
        """
        return self._send(self._required_mover(), goal, wait=wait)

    def execute(self, trajectory: Any, *, wait: bool = True) -> Any:
        """Execute a ``RobotTrajectory``; returns the result, None when it is not waited for.

        Raises:
            GazelleError: there is no move_group.
        """
        goal: Any = _EXECUTE.Goal()
        goal.trajectory = trajectory
        return self._send(self._executor, goal, wait=wait)

    def stop(self) -> None:
        """Stop what was sent last, and whatever else is being executed."""
        if self._running is not None:
            self._running.cancel()
        topic = self._name("trajectory_execution_event")
        publisher = self.node.create_publisher(topic, "std_msgs/msg/String", latch=True)
        publisher.publish(publisher.message_class(data="stop"))

    def call(self, name: str, kind: str, request: Any = None, **fields: Any) -> Any:
        """Call a service of move_group.

        Args:
            name: such as ``compute_ik``.
            kind: such as ``GetPositionIK``.
            request: the request, made of `fields` when None.
            fields: of the request, as mappings.

        Raises:
            GazelleError: nobody answers.
        """
        service = service_type(f"moveit_msgs/{kind}")
        if request is None:
            request = service.Request()
            fill(request, fields)
        if name not in self._clients:
            self._clients[name] = self.node.create_client(self._name(name), service)
        client = self._clients[name]
        if not client.wait_for_service(_CALL_S):
            raise GazelleError(f"nobody offers {self._name(name)}; is move_group running?")
        return client.call(request, timeout_s=_CALL_S)

    def _name(self, name: str) -> str:
        return f"{self._prefix}{name}"

    def _mover(self) -> ActionClient | None:
        return next((one for one in self._movers if one.is_server_ready), None)

    def _required_mover(self) -> ActionClient:
        if not self.wait(_CALL_S):
            raise GazelleError("Unable to connect to move_group action server: none is running")
        found = self._mover()
        assert found is not None
        return found

    def _send(self, client: ActionClient, goal: Any, *, wait: bool) -> Any:
        client.require_server(_CALL_S)
        self._running = client.send_goal(goal)
        if not wait:
            return None
        self._running.wait()
        return self._running.result
