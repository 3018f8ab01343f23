"""The client's side of actionlib's topics."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.graph.actions.client_events import ClientEvents
from gazelle.graph.actions.client_goal import ClientGoal, CommState, steps
from gazelle.graph.actions.goal import ActionlibStatus
from gazelle.graph.actions.types import ActionTypes
from gazelle.interfaces.stamps import set_stamp

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = ["ActionlibClient"]

_NUMBERS = itertools.count(1)
_BEFORE_OR_AFTER_THE_SERVER = (
    CommState.WAITING_FOR_GOAL_ACK,
    CommState.WAITING_FOR_RESULT,
    CommState.DONE,
)


class ActionlibClient:
    """Goals of one client, followed by their ids; those of others are not looked at."""

    def __init__(self, node: Node, name: str, types: ActionTypes) -> None:
        """Join the topics."""
        self._node = node
        self._types = types
        self._goals: dict[str, ClientGoal] = {}
        self._lock = threading.RLock()
        self._goal = node.create_publisher(f"{name}/goal", types.Envelope["goal"])
        self._cancel = node.create_publisher(f"{name}/cancel", types.GoalId)
        self._events = ClientEvents(node, name)
        status, feedback, result = (f"{name}/{topic}" for topic in ("status", "feedback", "result"))
        envelopes = types.Envelope
        self._topics = tuple(
            node.create_subscription(topic, message_type, take, inline=True)
            for topic, message_type, take in (
                (status, types.StatusArray, self._events.topic(status, self._on_status)),
                (feedback, envelopes["feedback"], self._events.topic(feedback, self._on_feedback)),
                (result, envelopes["result"], self._take_result),
            )
        )

    @property
    def is_connected(self) -> bool:
        """True when a server hears goals and cancel requests and can tell of them."""
        heard = self._goal.matched and self._cancel.matched
        return bool(heard and all(one.publisher_count for one in self._topics))

    def send(self, request: Any, **callbacks: Callable[..., None] | None) -> ClientGoal:
        """Send a goal."""
        message = self._types.Envelope["goal"](goal=request)
        now_ns = self._node.clock.now_ns()
        goal_id = f"{self._node.name}-{next(_NUMBERS)}-{now_ns / 1e9:.3f}"
        message.goal_id.id = goal_id
        set_stamp(message.goal_id.stamp, now_ns)
        set_stamp(message.header.stamp, now_ns)
        goal = ClientGoal(self, goal_id, request, ActionlibStatus.PENDING, **callbacks)
        with self._lock:
            self._goals[goal_id] = goal
        self._goal.publish(message)
        return goal

    def cancel_goal(self, goal: ClientGoal) -> None:
        """Ask the server to cancel one goal."""
        with goal.lock:
            self._cancel.publish(self._types.GoalId(id=goal.goal_id))
            if not goal.is_done:
                self._step(goal, CommState.WAITING_FOR_CANCEL_ACK)

    def cancel_all(self, stamp_ns: int = 0) -> None:
        """Ask to cancel all goals of all clients, or those sent until a time."""
        message = self._types.GoalId()
        set_stamp(message.stamp, stamp_ns)
        self._cancel.publish(message)

    def forget(self, goal: ClientGoal) -> None:
        """Follow a goal no more."""
        with self._lock:
            self._goals.pop(goal.goal_id, None)

    def close(self) -> None:
        """Leave the topics."""
        for topic in self._topics:
            topic.unregister()
        self._goal.unregister()
        self._cancel.unregister()
        self._events.close()

    def _take_result(self, message: Any) -> None:
        self._events.put(lambda: self._on_result(message))

    def _find(self, goal_id: str) -> ClientGoal | None:
        with self._lock:
            return self._goals.get(goal_id)

    def _on_status(self, message: Any) -> None:
        told = {one.goal_id.id: one for one in message.status_list}
        with self._lock:
            goals = tuple(self._goals.values())
        for goal in goals:
            with goal.lock:
                if goal.goal_id in told:
                    self._take_status(goal, told[goal.goal_id])
                # What is cancelled at once is missing in the lists that the server sent before.
                elif goal.is_acknowledged and goal.comm_state not in _BEFORE_OR_AFTER_THE_SERVER:
                    goal.status = ActionlibStatus.LOST
                    goal.text = "the server does not know the goal any more"
                    self._end(goal)

    def _on_feedback(self, message: Any) -> None:
        goal = self._find(message.status.goal_id.id)
        if goal is not None:
            goal.take_feedback(message.feedback)

    def _on_result(self, message: Any) -> None:
        goal = self._find(message.status.goal_id.id)
        if goal is None:
            return
        with goal.lock:
            goal.result = message.result
            self._take_status(goal, message.status)
            self._end(goal)

    def _take_status(self, goal: ClientGoal, told: Any) -> None:
        if goal.comm_state is CommState.DONE:
            return
        goal.is_acknowledged = True
        status = ActionlibStatus(told.status)
        states = steps(goal.comm_state, status)
        goal.status, goal.text = status, told.text
        if states is None:
            self._node.log(
                "error",
                f"Invalid goal status transition from {goal.comm_state.name} to {status.name}",
            )
            return
        for state in states:
            self._step(goal, state)

    def _end(self, goal: ClientGoal) -> None:
        if goal.comm_state is not CommState.DONE:
            self._step(goal, CommState.DONE)
            goal.finish()

    def _step(self, goal: ClientGoal, state: CommState) -> None:
        goal.comm_state = state
        if goal.on_transition is not None:
            goal.on_transition(goal)
