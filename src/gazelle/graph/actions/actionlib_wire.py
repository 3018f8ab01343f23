"""actionlib's topics: ``goal``, ``cancel``, ``status``, ``feedback`` and ``result``.

Source: http://wiki.ros.org/actionlib/DetailedDescription. The status is latched, and told five
times a second and on each change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.graph.actions.goal import ServerGoal
from gazelle.interfaces.stamps import ns_of, set_stamp

if TYPE_CHECKING:
    from gazelle.graph.actions.node_interface import ActionNode
    from gazelle.graph.actions.server import ActionServer

__all__ = ["ActionlibWire"]


class ActionlibWire:
    """The five topics of one server."""

    def __init__(self, node: ActionNode, server: ActionServer, *, inline: bool) -> None:
        """Offer the topics that tell; goals come after `listen`."""
        self._node = node
        self._server = server
        self._inline = inline
        self._types = types = server.types
        name = server.name
        self._status = node.create_publisher(f"{name}/status", types.StatusArray, latch=True)
        self._result = node.create_publisher(f"{name}/result", types.Envelope["result"])
        self._feedback = node.create_publisher(f"{name}/feedback", types.Envelope["feedback"])
        self._subscriptions: tuple[Any, ...] = ()

    def listen(self) -> None:
        """Take goals and cancel requests."""
        name, types = self._server.name, self._types
        self._subscriptions = tuple(
            self._node.create_subscription(f"{name}/{part}", kind, take, inline=self._inline)
            for part, kind, take in (
                ("goal", types.Envelope["goal"], self._on_goal),
                ("cancel", types.GoalId, self._on_cancel),
            )
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
        """Tell the status of all goals."""
        message = self._stamped(self._types.StatusArray)
        message.status_list = [self._status_of(goal) for goal in goals]
        self._status.publish(message)

    def send_result(self, goal: ServerGoal) -> None:
        """Tell the result of a goal that has ended."""
        if self._result.matched:
            self._publish(self._result, "result", goal, goal.result)

    def send_feedback(self, goal: ServerGoal, feedback: Any) -> None:
        """Tell how a goal goes."""
        self._publish(self._feedback, "feedback", goal, feedback)

    def close(self) -> None:
        """Take the topics off the graph."""
        for one in (*self._subscriptions, self._status, self._result, self._feedback):
            one.unregister()

    def _publish(self, publisher: Any, part: str, goal: ServerGoal, content: Any) -> None:
        message = self._stamped(self._types.Envelope[part])
        message.status = self._status_of(goal)
        setattr(message, part, content)
        publisher.publish(message)

    def _stamped(self, message_class: Any) -> Any:
        message = message_class()
        set_stamp(message.header.stamp, self._server.now_ns())
        return message

    def _status_of(self, goal: ServerGoal) -> Any:
        status = self._types.Status(status=int(goal.status), text=goal.text)
        status.goal_id.id = goal.goal_id
        set_stamp(status.goal_id.stamp, goal.stamp_ns)
        return status

    def _on_goal(self, message: Any) -> None:
        server = self._server
        goal_id = message.goal_id.id or server.new_id()
        stamp = ns_of(message.goal_id.stamp)
        goal = ServerGoal(server, goal_id, stamp, message.goal)
        server.post(lambda: server.take(goal))

    def _on_cancel(self, message: Any) -> None:
        stamp = ns_of(message.stamp)
        self._server.post(lambda: self._server.cancel_matching(message.id, stamp))
