"""The client's side of ROS 2's action services and topics."""

from __future__ import annotations

import threading
import uuid
from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.actions.client_events import ClientEvents
from gazelle.graph.actions.client_goal import ClientGoal
from gazelle.graph.actions.goal import Ros2Status
from gazelle.graph.actions.types import ActionTypes
from gazelle.graph.key_expressions import Kind
from gazelle.graph.service_requests import Turn, Turns
from gazelle.graph.sessions import CallsInFlight
from gazelle.interfaces.stamps import set_stamp

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = ["Ros2Client"]

_UNSENT_S = 2.0


class Ros2Client:
    """Goals of one client; each goal that runs has a thread that waits for its result."""

    def __init__(self, node: Node, name: str, types: ActionTypes) -> None:
        """Join services and topics."""
        self._node = node
        self._types = types
        self._goals: dict[str, ClientGoal] = {}
        self._turns = Turns()
        self._unsent_cancels = CallsInFlight()
        self._lock = threading.RLock()
        folder = f"{name}/_action"
        self._send = node.create_client(f"{folder}/send_goal", types.SendGoal)
        self._cancel = node.create_client(f"{folder}/cancel_goal", types.CancelGoal)
        self._result = node.create_client(f"{folder}/get_result", types.GetResult)
        self._events = ClientEvents(node, name)
        self._topics = tuple(
            node.create_subscription(
                topic, message_type, self._events.topic(topic, callback), inline=True
            )
            for topic, message_type, callback in (
                (f"{folder}/feedback", types.Envelope["feedback"], self._on_feedback),
                (f"{folder}/status", types.StatusArray, self._on_status),
            )
        )

    @property
    def is_connected(self) -> bool:
        """True when a server answers all services and can tell of goals."""
        clients = (self._send, self._cancel, self._result)
        known = self._node.graph.discovery.known()
        offered = {one.name for one in known if one.kind is Kind.SERVICE}
        return all(one.name in offered for one in clients) and all(
            one.publisher_count for one in self._topics
        )

    def send(self, request: Any, **callbacks: Callable[..., None] | None) -> ClientGoal:
        """Send a goal."""
        goal = ClientGoal(self, uuid.uuid4().hex, request, Ros2Status.UNKNOWN, **callbacks)
        with self._lock:
            self._goals[goal.goal_id] = goal
        self._start(self._follow, goal, self._turns.take())
        return goal

    def cancel_goal(self, goal: ClientGoal) -> None:
        """Ask the server to cancel one goal."""
        self._begin_cancel(goal.goal_id, 0)

    def cancel_all(self, stamp_ns: int = 0) -> None:
        """Ask to cancel all goals of all clients, or those accepted until a time."""
        self._begin_cancel("", stamp_ns)

    def forget(self, goal: ClientGoal) -> None:
        """Follow a goal no more."""
        with self._lock:
            self._goals.pop(goal.goal_id, None)

    def close(self) -> None:
        """Leave services and topics, behind the cancel requests that were made."""
        self._unsent_cancels.wait_until_none(_UNSENT_S)
        for topic in self._topics:
            topic.unregister()
        for client in (self._send, self._cancel, self._result):
            client.unregister()
        self._events.close()

    def _start(self, work: Callable[..., None], *args: Any) -> None:
        threading.Thread(target=work, args=args, name="action client", daemon=True).start()

    def _follow(self, goal: ClientGoal, turn: Turn) -> None:
        """Send a goal, behind those before it, and wait for its result."""
        request = self._types.SendGoal.Request(goal=goal.request)
        request.goal_id.uuid = bytes.fromhex(goal.goal_id)
        answer, status, text = None, Ros2Status.UNKNOWN, ""
        try:
            with turn:
                answered = self._send.send(request)
            if not answered().accepted:
                status = Ros2Status.REJECTED
            else:
                self._events.put(lambda: self._set(goal, Ros2Status.ACCEPTED))
                wanted = self._types.GetResult.Request()
                wanted.goal_id.uuid = bytes.fromhex(goal.goal_id)
                answer = self._result.call(wanted)
                status = Ros2Status(answer.status)
        except GraphError as error:
            text = str(error)
        result = None if answer is None else answer.result
        self._events.put(lambda: self._finish(goal, status, result, text))

    def _finish(self, goal: ClientGoal, status: Ros2Status, result: Any, text: str) -> None:
        goal.result, goal.text = result, text
        if text:
            goal.status = status
        else:
            self._set(goal, status)
        goal.finish()

    def _begin_cancel(self, goal_id: str, stamp_ns: int) -> None:
        unsent = ExitStack()
        unsent.enter_context(self._unsent_cancels.waiting())
        self._start(self._ask_cancel, goal_id, stamp_ns, self._turns.take(), unsent)

    def _ask_cancel(self, goal_id: str, stamp_ns: int, turn: Turn, unsent: ExitStack) -> None:
        request = self._types.CancelGoal.Request()
        if goal_id:
            request.goal_info.goal_id.uuid = bytes.fromhex(goal_id)
        set_stamp(request.goal_info.stamp, stamp_ns)
        try:
            with unsent, turn:
                answered = self._cancel.send(request)
            answered()
        except GraphError as error:
            if not self._node.closed:
                self._node.log("error", f"cancel request failed: {error}")

    def _set(self, goal: ClientGoal, status: Ros2Status) -> None:
        """Note a status; topic and services may tell them in any order, so only onwards."""
        with goal.lock:
            is_new = status > goal.status or status is Ros2Status.REJECTED
            if is_new and not goal.status.is_terminal:
                goal.status = status
                if goal.on_transition is not None:
                    goal.on_transition(goal)

    def _on_feedback(self, message: Any) -> None:
        goal = self._goals.get(bytes(message.goal_id.uuid).hex())
        if goal is not None:
            goal.take_feedback(message.feedback)

    def _on_status(self, message: Any) -> None:
        for one in message.status_list:
            goal = self._goals.get(bytes(one.goal_info.goal_id.uuid).hex())
            status = Ros2Status(one.status)
            if goal is not None and not status.is_terminal:
                # The end is told together with the result.
                self._set(goal, status)
