"""ActionServer of ROS 2 (rclpy.action.server)."""

from __future__ import annotations

import enum
import inspect
import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.executors import Once
from gazelle.compat.rclpy.publisher_subscription_service import check_type
from gazelle.compat.rclpy.qos import (
    QoSProfile,
    qos_profile_action_status_default,
    qos_profile_services_default,
    tell_unusual_qos,
)
from gazelle.compat.warn_once import warn_once
from gazelle.graph.actions import ActionServer as _Server
from gazelle.graph.actions import (
    ActionTiming,
    GoalEvent,
    GoalStateError,
    Ros2Status,
    ServerGoal,
)
from gazelle.graph.actions.goal import next_status, state_error
from gazelle.interfaces import message_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "ActionServer",
    "CancelResponse",
    "GoalEvent",
    "GoalResponse",
    "ServerGoalHandle",
    "default_cancel_callback",
    "default_goal_callback",
    "default_handle_accepted_callback",
]

Callback = Callable[[Any], Any]


class GoalResponse(enum.Enum):
    """What a goal callback answers."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(enum.Enum):
    """What a cancel callback answers."""

    REJECT = 1
    ACCEPT = 2


class ServerGoalHandle:
    """One goal at the server.

    It ends where the execute callback returns: `succeed`, `abort` and `canceled` say how, and the
    callback's value is the result.
    """

    def __init__(self, action_server: ActionServer, goal: ServerGoal) -> None:
        self._server = action_server
        self._goal = goal
        self._end: GoalEvent | None = None

    @property
    def request(self) -> Any:
        """The goal message."""
        return self._goal.request

    @property
    def goal_id(self) -> Any:
        """``unique_identifier_msgs/msg/UUID``."""
        make = message_type("unique_identifier_msgs/msg/UUID")
        return make(uuid=bytes.fromhex(self._goal.goal_id))

    @property
    def is_active(self) -> bool:
        """True from the acceptance to the end."""
        return self._end is None and self._goal.is_active

    @property
    def is_cancel_requested(self) -> bool:
        """True once a client asked to cancel and the server agreed."""
        return self._end is None and self._goal.is_cancel_requested

    @property
    def status(self) -> int:
        """``action_msgs/msg/GoalStatus``."""
        if self._end is not None and not self._goal.status.is_terminal:
            return int(next_status(self._goal.status, self._end) or self._goal.status)
        return int(self._goal.status)

    def execute(self, execute_callback: Callback | None = None) -> None:
        """Begin: the status is EXECUTING and the execute callback is called.

        Raises:
            GoalStateError: it has begun before, or is cancelled.
        """
        if not self._goal.is_cancel_requested:
            self._goal.execute()
        self._server.begin(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how it goes.

        Raises:
            TypeError: the message is of another type.
        """
        wanted = self._server.action_type.Feedback
        if not isinstance(feedback, wanted):
            raise TypeError(f"Expected {wanted.__qualname__}, got {type(feedback).__qualname__}")
        self._goal.publish_feedback(feedback)

    def succeed(self) -> None:
        """End it well.

        Raises:
            GoalStateError: it is not being executed.
        """
        self._note(GoalEvent.SUCCEED)

    def abort(self) -> None:
        """End it because it cannot be reached.

        Raises:
            GoalStateError: it is not being executed.
        """
        self._note(GoalEvent.ABORT)

    def canceled(self) -> None:
        """End it because a client wanted so.

        Raises:
            GoalStateError: no client wanted so.
        """
        self._note(GoalEvent.CANCEL)

    def destroy(self) -> None:
        """Nothing to do: goals are forgotten with time."""

    def finish(self, result: Any) -> None:
        """End it with a result, as noted; aborted when nothing was."""
        end = {GoalEvent.SUCCEED: self._goal.succeed, GoalEvent.CANCEL: self._goal.cancel}
        if not self._goal.status.is_terminal:
            end.get(self._end or GoalEvent.ABORT, self._goal.abort)(result)

    def _note(self, event: GoalEvent) -> None:
        if self._end is not None or next_status(self._goal.status, event) is None:
            raise state_error(self._goal.goal_id, Ros2Status(self.status), event)
        self._end = event

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and other._goal is self._goal

    def __hash__(self) -> int:
        return hash(self._goal.goal_id)


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Begin at once."""
    goal_handle.execute()


def default_goal_callback(goal_request: Any) -> GoalResponse:
    """Take every goal."""
    del goal_request
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: Any) -> CancelResponse:
    """Let nothing be cancelled."""
    del cancel_request
    return CancelResponse.REJECT


class ActionServer:
    """Takes goals of one action; callbacks run while the node spins.

    Args:
        node: the node.
        action_type: such as ``example_interfaces.action.Fibonacci``.
        action_name: any legal name.
        execute_callback: called with a goal's handle, and returns the result message.
        callback_group: the node's own by default.
        goal_callback: takes a goal message, returns `GoalResponse`.
        handle_accepted_callback: takes an accepted goal's handle, and lets it `execute`.
        cancel_callback: takes a goal's handle, returns `CancelResponse`.
        goal_service_qos_profile, result_service_qos_profile, cancel_service_qos_profile,
            feedback_pub_qos_profile, status_pub_qos_profile: told once where one asks for
            something else than an action's own profiles.
        result_timeout: how long results are kept, in seconds.

    Raises:
        AttributeError: the type is no action of ROS 2.
    """

    def __init__(  # noqa: PLR0913 - rclpy's signature
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        execute_callback: Callback,
        *,
        callback_group: CallbackGroup | None = None,
        goal_callback: Callback = default_goal_callback,
        handle_accepted_callback: Callback = default_handle_accepted_callback,
        cancel_callback: Callback = default_cancel_callback,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_pub_qos_profile: QoSProfile = qos_profile_services_default,
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        result_timeout: float = 900,
    ) -> None:
        check_type(action_type, "action")
        for profile in (
            goal_service_qos_profile,
            result_service_qos_profile,
            cancel_service_qos_profile,
            feedback_pub_qos_profile,
        ):
            tell_unusual_qos(f"action '{action_name}'", profile)
        if status_pub_qos_profile != qos_profile_action_status_default:
            warn_once(f"action '{action_name}': its status is latched, whatever QoS is asked for")
        self.action_type = action_type
        self.callback_group = callback_group or node.default_callback_group
        self._node = node
        self._logger = node.get_logger().get_child("action_server")
        self.register_goal_callback(goal_callback)
        self.register_handle_accepted_callback(handle_accepted_callback)
        self.register_cancel_callback(cancel_callback)
        self.register_execute_callback(execute_callback)
        self._handles: dict[str, ServerGoalHandle] = {}
        self._server = _Server(
            node.graph_node,
            action_name,
            action_type,
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
            ros_version=2,
            run=self._post,
            timing=ActionTiming(result_timeout_s=result_timeout),
        )
        node.keep_entity(self)

    def register_goal_callback(self, goal_callback: Callback | None) -> None:
        """Set what decides on goals; the default takes all.

        Raises:
            TypeError: it is not callable.
        """
        self._goal_callback = _callable(goal_callback, default_goal_callback)

    def register_handle_accepted_callback(self, callback: Callback | None) -> None:
        """Set what lets accepted goals execute; the default does at once.

        Raises:
            TypeError: it is not callable.
        """
        self._accepted_callback = _callable(callback, default_handle_accepted_callback)

    def register_cancel_callback(self, cancel_callback: Callback | None) -> None:
        """Set what decides on cancel requests; the default refuses.

        Raises:
            TypeError: it is not callable.
        """
        self._cancel_callback = _callable(cancel_callback, default_cancel_callback)

    def register_execute_callback(self, execute_callback: Callback) -> None:
        """Set what executes goals.

        Raises:
            TypeError: it is not callable.
        """
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self._execute_callback = execute_callback

    def destroy(self) -> None:
        """Stop offering the action; goals that run are aborted."""
        self._server.close()

    def begin(self, handle: ServerGoalHandle, execute_callback: Callback | None) -> None:
        """Run the execute callback as a task of the executor, beside other callbacks."""
        executor = self._node.executor
        executor.create_task(self._execute, execute_callback or self._execute_callback, handle)

    def _post(self, work: Callable[[], object]) -> None:
        self._node.post_work(Once(self.callback_group, work))

    def _on_goal(self, goal: ServerGoal) -> None:
        handle = self._handles[goal.goal_id] = ServerGoalHandle(self, goal)
        self._later(self._decide, handle)

    async def _decide(self, handle: ServerGoalHandle) -> None:
        goal = handle._goal
        try:
            answer = await _value(self._goal_callback(goal.request))
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            self._logger.error(f"Error raised in goal callback: {error}")
            answer = GoalResponse.REJECT
        if not isinstance(answer, GoalResponse):
            self._logger.warning(
                "Goal request callback did not return a GoalResponse type. Rejecting goal."
            )
        if answer is not GoalResponse.ACCEPT:
            del self._handles[goal.goal_id]
            goal.reject()
            return
        goal.accept_deferred()
        await _value(self._accepted_callback(handle))

    def _on_cancel(self, goal: ServerGoal) -> bool:
        handle = self._handles[goal.goal_id]
        answer = self._cancel_callback(handle)
        if inspect.isawaitable(answer):
            # Its `await`s cannot be waited for here; plain coroutines need none.
            answer = _finished(answer)
        return answer is CancelResponse.ACCEPT

    async def _execute(self, callback: Callback, handle: ServerGoalHandle) -> None:
        result = None
        try:
            result = await _value(callback(handle))
        except Exception:  # noqa: BLE001 - a user's callback may raise anything
            self._logger.error(f"Error raised in execute callback: {traceback.format_exc()}")
        if handle._end is None:
            self._logger.warning(
                f"Goal state not set, assuming aborted. Goal ID: {handle._goal.goal_id}"
            )
        try:
            handle.finish(result)
        except GoalStateError as error:
            self._logger.error(str(error))
        self._handles.pop(handle._goal.goal_id, None)

    def _later(self, work: Callable[..., Any], *args: Any) -> None:
        """Run a coroutine with the rights of the callback that runs now."""
        self._node.executor.create_task(work, *args)


def _callable(callback: Callback | None, default: Callback) -> Callback:
    if callback is None:
        return default
    if not callable(callback):
        raise TypeError("Failed to register callback: not callable")
    return callback


async def _value(found: Any) -> Any:
    return await found if inspect.isawaitable(found) else found


def _finished(coroutine: Any) -> Any:
    try:
        coroutine.send(None)
    except StopIteration as end:
        return end.value
    coroutine.close()
    return CancelResponse.REJECT
