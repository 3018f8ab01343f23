"""The world of behaviour trees, over the graph: actions, services, topics, tf."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError
from gazelle.graph import Qos
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.nav2.behavior_trees.ros_interface import Pose2
from gazelle.nodes.navigation.robot_pose import Frames, Odometry

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["GraphInterface"]

_SERVER_S = 10.0
_SERVICE_S = 10.0


class GraphInterface:
    """What the leaves of trees ask for; see `RosInterface`."""

    def __init__(
        self,
        node: Node,
        frames: Frames,
        odometry: Odometry,
        *,
        global_frame: str,
        base_frame: str,
        tolerance_s: float,
    ) -> None:
        """Ask nothing yet."""
        self._node = node
        self._frames = frames
        self._odometry = odometry
        self._names = (global_frame, base_frame)
        self._tolerance_s = tolerance_s
        self._clients: dict[str, ActionClient] = {}
        self._topics: dict[str, list[Any]] = {}

    def now_ns(self) -> int:
        """Tell the time."""
        return self._node.clock.now_ns()

    def pose(self, global_frame: str = "", base_frame: str = "") -> Pose2 | None:
        """Return where the robot is."""
        names = (global_frame or self._names[0], base_frame or self._names[1])
        found = self._frames.robot(*names, self._tolerance_s, refuses_late=False)
        if isinstance(found, str):
            self._frames.say("warn", found, key=f"pose {names}")
            return None
        return Pose2(*found.pose)

    def can_transform(self, parent: str, child: str) -> bool:
        """Tell whether tf connects two frames."""
        return not isinstance(self._frames.between(parent, child), str)

    def in_frame(self, pose: Any, frame: str = "") -> Any:
        """Return a pose in a frame, None if tf fails."""
        found = self._frames.message_in(pose, frame or self._names[0])
        return None if isinstance(found, str) else found

    def speed_m_s(self) -> float:
        """Return the robot's speed."""
        return self._odometry.speed_m_s

    def action(self, name: str, kind: str, goal: Any) -> _ActionCall:
        """Send a goal, in a thread of its own until it is on its way."""
        return _ActionCall(self._client(name, kind), goal)

    def cancel_all(self, name: str, kind: str) -> None:
        """Cancel all goals of an action."""
        client = self._client(name, kind)
        if client.is_server_ready:
            client.cancel_all()

    def service(self, name: str, kind: str, request: Any) -> _ServiceCall:
        """Call a service, in a thread of its own."""
        return _ServiceCall(self._node, name, kind, request)

    def latest(self, topic: str, kind: str, *, latched: bool = False) -> Any:
        """Return a topic's last message; the first question begins to listen."""
        held = self._topics.get(topic)
        if held is None:
            held = self._topics[topic] = []

            def keep(message: Any) -> None:
                held[:] = [message]

            qos = Qos(True, True, 1) if latched else None
            self._node.create_subscription(topic, kind, keep, queue_size=1, qos=qos)
        return held[-1] if held else None

    def message(self, kind: str) -> Any:
        """Return a new message, or a service's request."""
        return service_type(kind).Request() if "/srv/" in kind else message_type(kind)()

    def log(self, level: str, text: str) -> None:
        """Say something."""
        self._node.log(level, text)

    def _client(self, name: str, kind: str) -> ActionClient:
        if name not in self._clients:
            package, _, bare = kind.split("/")
            self._clients[name] = ActionClient(self._node, name, f"{package}/{bare}", ros_version=2)
        return self._clients[name]


class _Call:
    """Something under way, watched by the tree at each tick."""

    def __init__(self) -> None:
        self.result: Any = None
        self.feedback: Any = None
        self.why = ""
        self.is_done = False
        self.succeeded = False

    def _end(self, succeeded: bool, why: str = "") -> None:
        self.succeeded, self.why = succeeded, why
        self.is_done = True


class _ActionCall(_Call):
    def __init__(self, client: ActionClient, goal: Any) -> None:
        super().__init__()
        self._client = client
        self._goal: ClientGoal | None = None
        self._cancelled = False
        self._lock = threading.Lock()
        if client.is_server_ready:
            self._send(goal)
        else:
            threading.Thread(target=self._wait_and_send, args=(goal,), daemon=True).start()

    def cancel(self) -> None:
        """Ask for the goal's end, also when it is not sent yet."""
        with self._lock:
            self._cancelled = True
            goal = self._goal
        if goal is not None and not goal.is_done:
            goal.cancel()

    def _wait_and_send(self, goal: Any) -> None:
        deadline = time.monotonic() + _SERVER_S
        while not self._client.wait_for_server(0.2):
            if self._cancelled or time.monotonic() > deadline:
                self._end(False, f"action server {self._client.name} is not there")
                return
        self._send(goal)

    def _send(self, goal: Any) -> None:
        try:
            message = _goal_message(self._client.types.Goal, goal)
            sent = self._client.send_goal(
                message, on_feedback=self._on_feedback, on_done=self._on_done, check=False
            )
        except GazelleError as error:
            self._end(False, str(error))
            return
        with self._lock:
            self._goal = sent
            cancelled = self._cancelled
        if cancelled:
            sent.cancel()

    def _on_feedback(self, feedback: Any) -> None:
        self.feedback = feedback

    def _on_done(self, goal: ClientGoal) -> None:
        self.result = goal.result
        succeeded = goal.status.name == "SUCCEEDED"
        said = getattr(goal.result, "error_msg", "") or goal.text
        self._end(succeeded, "" if succeeded else f"{goal.status.name.lower()}: {said}")


class _ServiceCall(_Call):
    def __init__(self, node: Node, name: str, kind: str, request: Any) -> None:
        super().__init__()
        self._work = (node, name, service_type(kind), request)
        threading.Thread(target=self._run, name=f"call {name}", daemon=True).start()

    def cancel(self) -> None:
        """Do not wait for the answer; the service itself cannot be stopped."""

    def _run(self) -> None:
        node, name, kind, request = self._work
        client = node.create_client(name, kind)
        try:
            if not client.wait_for_service(_SERVICE_S):
                self._end(False, f"service {client.name} is not there")
                return
            self.result = client.call(request, timeout_s=_SERVICE_S)
            self._end(True)
        except GazelleError as error:
            self._end(False, str(error))
        finally:
            client.unregister()


def _goal_message(goal_class: Any, fields: Any) -> Any:
    """Return a goal of messages, numbers and mappings by field."""
    from gazelle.interfaces import fill

    made = goal_class()
    for name, value in fields.items():
        if isinstance(value, dict):
            fill(getattr(made, name), value)
        elif hasattr(made, name) and hasattr(getattr(made, name), "goals"):
            getattr(made, name).goals = list(value)
        elif hasattr(made, name):
            setattr(made, name, value)
    return made
