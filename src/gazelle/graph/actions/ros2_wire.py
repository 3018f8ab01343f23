"""ROS 2's services and topics of an action, below ``<name>/_action``.

Source: https://design.ros2.org/articles/actions.html and ros2/rcl's ``rcl_action``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.graph.actions.goal import Ros2Status, ServerGoal
from gazelle.graph.errors import ServiceRefusedError
from gazelle.graph.service_requests import InTurn
from gazelle.interfaces.stamps import ns_of, set_stamp

if TYPE_CHECKING:
    from gazelle.graph.actions.node_interface import ActionNode
    from gazelle.graph.actions.server import ActionServer

__all__ = ["Ros2Wire"]

_NONE, _REJECTED, _UNKNOWN_GOAL_ID, _GOAL_TERMINATED = range(4)
_NO_ID = "0" * 32


class Ros2Wire:
    """The three services and two topics of one server."""

    def __init__(self, node: ActionNode, server: ActionServer) -> None:
        """Offer the topics; the services come with `listen`."""
        self._node = node
        self._server = server
        self._types = types = server.types
        self._blocks = getattr(node, "clock", None) is not None
        self._name = name = f"{server.name}/_action"
        self._feedback = node.create_publisher(f"{name}/feedback", types.Envelope["feedback"])
        self._status = node.create_publisher(f"{name}/status", types.StatusArray, latch=True)
        self._services: tuple[Any, ...] = ()

    def listen(self) -> None:
        """Take goals, cancel requests and questions for results."""
        name, node, types = self._name, self._node, self._types
        self._services = (
            node.create_service(f"{name}/send_goal", types.SendGoal, InTurn(self._on_goal)),
            node.create_service(f"{name}/cancel_goal", types.CancelGoal, self._on_cancel),
            node.create_service(f"{name}/get_result", types.GetResult, self._on_result),
        )

    @property
    def wants_feedback(self) -> bool:
        """True when somebody listens to feedback."""
        return bool(self._feedback.matched)

    @property
    def wants_status(self) -> bool:
        """True when somebody listens to the status."""
        return bool(self._status.matched)

    def send_status(self, goals: list[ServerGoal]) -> None:
        """Tell the status of all accepted goals."""
        message = self._types.StatusArray()
        for goal in goals:
            if goal.status > Ros2Status.UNKNOWN:
                status = self._types.Status(status=int(goal.status))
                self._write_info(status.goal_info, goal)
                message.status_list.append(status)
        self._status.publish(message)

    def send_result(self, goal: ServerGoal) -> None:
        """Do nothing: whoever wants the result asks the service, which wakes by itself."""

    def send_feedback(self, goal: ServerGoal, feedback: Any) -> None:
        """Tell how a goal goes."""
        message = self._types.Envelope["feedback"](feedback=feedback)
        message.goal_id.uuid = bytes.fromhex(goal.goal_id)
        self._feedback.publish(message)

    def close(self) -> None:
        """Take services and topics off the graph."""
        for one in (*self._services, self._status, self._feedback):
            one.unregister()

    def _on_goal(self, request: Any) -> Callable[[], Any]:
        goal_id = _hex(request.goal_id)
        response = self._types.SendGoal.Response(accepted=False)
        goal = ServerGoal(self._server, goal_id, self._server.now_ns(), request.goal)
        taken = self._server.asked(lambda: self._server.take(goal))

        def decided() -> Any:
            if not taken():
                return response
            with self._server.waiting(goal.decided):
                self._wait(goal.decided.is_set(), "decided on")
                goal.decided.wait()
            response.accepted = goal.status > Ros2Status.UNKNOWN
            set_stamp(response.stamp, goal.stamp_ns)
            return response

        return decided

    def _on_cancel(self, request: Any) -> Any:
        server = self._server
        goal_id = _hex(request.goal_info.goal_id)
        goal_id = "" if goal_id == _NO_ID else goal_id
        stamp = ns_of(request.goal_info.stamp)
        response = self._types.CancelGoal.Response()
        known = server.goal_with(goal_id) if goal_id else None
        if goal_id and known is None:
            response.return_code = _UNKNOWN_GOAL_ID
            return response
        was_over = known is not None and not known.is_cancelable
        chosen, canceling = server.ask(lambda: server.cancel_matching(goal_id, stamp))
        for goal in canceling:
            info = self._types.Status().goal_info
            self._write_info(info, goal)
            response.goals_canceling.append(info)
        if was_over:
            response.return_code = _GOAL_TERMINATED
        elif chosen and not canceling:
            response.return_code = _REJECTED
        return response

    def _on_result(self, request: Any) -> Any:
        goal = self._server.goal_with(_hex(request.goal_id))
        response = self._types.GetResult.Response()
        if goal is None:
            return response
        with self._server.waiting(goal.ended):
            self._wait(goal.ended.is_set(), "over")
            goal.ended.wait()
        response.status = max(int(goal.status), int(Ros2Status.UNKNOWN))
        if goal.result is not None:
            response.result = goal.result
        return response

    def _wait(self, is_there: bool, what: str) -> None:
        """Refuse to wait where the caller is the only thread.

        Raises:
            ServiceRefusedError: it would wait for ever.
        """
        if not is_there and not self._blocks:
            raise ServiceRefusedError(
                f"action {self._server.name}: the goal is not {what} yet; step the world first"
            )

    def _write_info(self, info: Any, goal: ServerGoal) -> None:
        info.goal_id.uuid = bytes.fromhex(goal.goal_id)
        set_stamp(info.stamp, goal.stamp_ns)


def _hex(goal_id: Any) -> str:
    return bytes(goal_id.uuid).hex()
