"""``action``: a goal, its feedback and its result."""

from __future__ import annotations

import threading
from typing import Any, TypedDict

from gazelle.graph import Clock, Graph, Node
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.studio.errors import unknown
from gazelle.studio.graph_view.message_forms import filled
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream

__all__ = ["ActionOpened", "GoalState", "open_action"]

_SERVER_S = 2.0


class ActionOpened(TypedDict):
    """What is told when the stream `action` is open: the goal is on its way."""

    type: str
    goal_id: str


class GoalState(TypedDict):
    """How a goal stands, of the stream `action`.

    Attributes:
        state: in capitals, as in `SUCCEEDED`.
        feedback: the last one, null before it.
        result: null before it.
    """

    state: str
    text: str
    feedback: Any
    result: Any


def open_action(node: Node, channel: Channel, params: Params) -> OpenStream:
    """Stream ``action``: sends the goal; closing the channel cancels it."""
    name = node.resolve_name(params.text("action"))
    type_name = params.text("type", "") or _type_of(node.graph, name)
    client = ActionClient(node, name, type_name)
    try:
        client.require_server(_SERVER_S)
        goal = filled_goal(client, params.object("goal", {}), node.clock)
        talk = _Talk(channel, client)
        talk.goal = client.send_goal(
            goal, on_feedback=talk.tell, on_done=talk.finish, on_transition=talk.tell
        )
    except Exception:
        client.close()
        raise
    talk.tell(talk.goal)
    info: ActionOpened = {"type": client.type_name, "goal_id": talk.goal.goal_id}
    return OpenStream(talk.close, info)


def filled_goal(client: ActionClient, values: dict[str, Any], clock: Clock) -> Any:
    """Return the goal message of a form."""
    from gazelle.interfaces import action_type

    return filled(action_type(client.type_name).Goal, values, clock.now_ns())


class _Talk:
    """What is told of one goal."""

    def __init__(self, channel: Channel, client: ActionClient) -> None:
        self.goal: ClientGoal | None = None
        self._channel = channel
        self._client = client
        self._lock = threading.Lock()
        self._over = False

    def tell(self, _news: Any) -> None:
        """Send how things stand."""
        goal = self.goal
        if goal is None:
            return
        state: GoalState = {
            "state": goal.status.name,
            "text": goal.text,
            "feedback": None if goal.feedback is None else message_value(goal.feedback),
            "result": None if goal.result is None else message_value(goal.result),
        }
        self._channel.send(state)

    def finish(self, goal: ClientGoal) -> None:
        """Send the result; the stream is over."""
        self.goal = goal
        with self._lock:
            self._over = True
        self.tell(goal)
        self._channel.end()

    def close(self) -> None:
        """Cancel the goal if it goes on, and leave."""
        with self._lock:
            over = self._over
        if self.goal is not None and not over:
            self.goal.cancel()
            self.goal.forget()
        self._client.close()


def _type_of(graph: Graph, name: str) -> str:
    types = {one.name: one.type_name for one in graph.actions()}
    if name not in types:
        raise unknown("action", name, types)
    return types[name]
