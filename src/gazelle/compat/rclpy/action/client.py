"""ActionClient of ROS 2 (rclpy.action.client)."""

from __future__ import annotations

import threading
import time
import uuid
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.publisher_subscription_service import check_type
from gazelle.compat.rclpy.qos import (
    QoSProfile,
    qos_profile_action_status_default,
    qos_profile_services_default,
)
from gazelle.compat.rclpy.task import Future
from gazelle.graph.actions import Ros2Status
from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = ["ActionClient", "ClientGoalHandle"]

_POLL_S = 0.05
_FEEDBACK_DEPTH = 10


class ClientGoalHandle:
    """A goal that was sent and answered."""

    def __init__(self, action_client: ActionClient, goal_id: Any, answer: Any) -> None:
        self._client = action_client
        self._goal_id = goal_id
        self._answer = answer
        self._status = int(Ros2Status.UNKNOWN)

    @property
    def goal_id(self) -> Any:
        """``unique_identifier_msgs/msg/UUID``."""
        return self._goal_id

    @property
    def stamp(self) -> Any:
        """When the server took it."""
        return self._answer.stamp

    @property
    def accepted(self) -> bool:
        """True when the server took it."""
        return bool(self._answer.accepted)

    @property
    def status(self) -> int:
        """The last known ``action_msgs/msg/GoalStatus``."""
        return self._status

    def cancel_goal(self) -> Any:
        """Ask to cancel and wait; return ``CancelGoal.Response``. Somebody else must spin."""
        return _waited(self.cancel_goal_async())

    def cancel_goal_async(self) -> Future:
        """Ask to cancel; the future gives ``CancelGoal.Response``."""
        return self._client.ask_cancel(self)

    def get_result(self) -> Any:
        """Wait for the end; return status and result. Somebody else must spin."""
        return _waited(self.get_result_async())

    def get_result_async(self) -> Future:
        """Ask for the result; the future gives a message with ``status`` and ``result``."""
        return self._client.ask_result(self)

    def note(self, status: int) -> None:
        """Note a status that the server told; only onwards."""
        if not Ros2Status(self._status).is_terminal and status > self._status:
            self._status = status

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and _key(self._goal_id) == _key(other.goal_id)

    def __hash__(self) -> int:
        return hash(_key(self._goal_id))

    def __repr__(self) -> str:
        return (
            f"ClientGoalHandle <id={self._goal_id.uuid}, accepted={self.accepted}, "
            f"status={self._status}>"
        )


class ActionClient:
    """Sends goals of one action; callbacks run while the node spins.

    Args:
        node: the node.
        action_type: such as ``example_interfaces.action.Fibonacci``.
        action_name: any legal name.
        callback_group: the node's own by default.
        goal_service_qos_profile, result_service_qos_profile, cancel_service_qos_profile: told
            once where one asks for less or more than reliable services.
        feedback_sub_qos_profile, status_sub_qos_profile: of the two topics.

    Raises:
        AttributeError: the type is no action of ROS 2.
    """

    def __init__(  # noqa: PLR0913 - rclpy's signature
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        *,
        callback_group: CallbackGroup | None = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile | int = _FEEDBACK_DEPTH,
        status_sub_qos_profile: QoSProfile | int = qos_profile_action_status_default,
    ) -> None:
        check_type(action_type, "action")
        self._node = node
        self._action_type = action_type
        self._action_name = action_name
        self._feedback: dict[bytes, Callable[[Any], Any]] = {}
        self._handles: dict[bytes, ClientGoalHandle] = {}
        folder = f"{node.resolve_topic_name(action_name)}/_action"
        self._send, self._cancel, self._result = (
            node.create_client(
                kind, f"{folder}/{name}", qos_profile=profile, callback_group=callback_group
            )
            for kind, name, profile in (
                (action_type.SendGoal, "send_goal", goal_service_qos_profile),
                (
                    service_type("action_msgs/srv/CancelGoal"),
                    "cancel_goal",
                    cancel_service_qos_profile,
                ),
                (action_type.GetResult, "get_result", result_service_qos_profile),
            )
        )
        self._topics = (
            node.create_subscription(
                action_type.FeedbackMessage,
                f"{folder}/feedback",
                self._on_feedback,
                feedback_sub_qos_profile,
                callback_group=callback_group,
            ),
            node.create_subscription(
                message_type("action_msgs/msg/GoalStatusArray"),
                f"{folder}/status",
                self._on_status,
                status_sub_qos_profile,
                callback_group=callback_group,
            ),
        )

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Send a goal and wait for its end; None when it was rejected. Somebody else must spin."""
        handle = _waited(self.send_goal_async(goal, **kwargs))
        return handle.get_result() if handle.accepted else None

    def send_goal_async(
        self,
        goal: Any,
        feedback_callback: Callable[[Any], Any] | None = None,
        goal_uuid: Any = None,
    ) -> Future:
        """Send a goal; the future gives a `ClientGoalHandle`.

        Args:
            goal: such as ``Fibonacci.Goal``.
            feedback_callback: called with messages whose ``feedback`` is the goal's.
            goal_uuid: ``unique_identifier_msgs/msg/UUID``, made up by default.

        Raises:
            TypeError: the goal is a message of another type.
        """
        if not isinstance(goal, self._action_type.Goal):
            raise TypeError(
                f"Expected {self._action_type.Goal.__qualname__}, got {type(goal).__qualname__}"
            )
        make = message_type("unique_identifier_msgs/msg/UUID")
        goal_id = goal_uuid or make(uuid=uuid.uuid4().bytes)
        if feedback_callback is not None:
            self._feedback[_key(goal_id)] = feedback_callback
        request = self._action_type.SendGoal.Request(goal_id=goal_id, goal=goal)
        answered = self._send.call_async(request)
        return self._then(answered, lambda answer: self._sent(goal_id, answer))

    def server_is_ready(self) -> bool:
        """Tell whether there is a server."""
        clients = (self._send, self._cancel, self._result)
        ready = all(one.service_is_ready() for one in clients)
        return ready and all(one.get_publisher_count() for one in self._topics)

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Wait until there is a server; False when time is up first."""
        deadline = None if timeout_sec is None else time.monotonic() + timeout_sec
        while not self.server_is_ready():
            if not self._node.context.ok():
                return False
            if deadline is not None and time.monotonic() >= deadline:
                return False
            self._send.wait_for_service(_POLL_S)
            time.sleep(0.005)
        return True

    def destroy(self) -> None:
        """Leave the action; goals go on without this client."""
        for client in (self._send, self._cancel, self._result):
            self._node.destroy_client(client)
        for topic in self._topics:
            self._node.destroy_subscription(topic)

    def ask_cancel(self, handle: ClientGoalHandle) -> Future:
        """Ask to cancel one goal."""
        request = self._cancel.srv_type.Request()
        request.goal_info.goal_id = handle.goal_id
        return self._cancel.call_async(request)

    def ask_result(self, handle: ClientGoalHandle) -> Future:
        """Ask for one goal's result."""
        request = self._action_type.GetResult.Request(goal_id=handle.goal_id)

        def ended(answer: Any) -> Any:
            handle.note(int(answer.status))
            self._feedback.pop(_key(handle.goal_id), None)
            self._handles.pop(_key(handle.goal_id), None)
            return answer

        return self._then(self._result.call_async(request), ended)

    def _sent(self, goal_id: Any, answer: Any) -> ClientGoalHandle:
        handle = ClientGoalHandle(self, goal_id, answer)
        if handle.accepted:
            self._handles[_key(goal_id)] = handle
            handle.note(int(Ros2Status.ACCEPTED))
        else:
            self._feedback.pop(_key(goal_id), None)
        return handle

    def _then(self, first: Future, change: Callable[[Any], Any]) -> Future:
        """Return a future with the first one's result changed, done in the same moment."""
        last = Future(executor=self._node.executor)

        def pass_on(done: Any) -> None:
            if done.cancelled():
                last.cancel()
            elif done.exception() is not None:
                last.set_exception(done.exception())
            else:
                last.set_result(change(done.result()))

        first.wake_with(pass_on)
        return last

    def _on_feedback(self, message: Any) -> Any:
        callback = self._feedback.get(_key(message.goal_id))
        return None if callback is None else callback(message)

    def _on_status(self, message: Any) -> None:
        for one in message.status_list:
            handle = self._handles.get(_key(one.goal_info.goal_id))
            if handle is not None:
                handle.note(int(one.status))


def _key(goal_id: Any) -> bytes:
    return bytes(goal_id.uuid)


def _waited(future: Future) -> Any:
    done = threading.Event()
    future.wake_with(lambda _future: done.set())
    done.wait()
    return future.result()
