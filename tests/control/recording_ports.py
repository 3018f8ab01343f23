"""Ports of a controller without a graph: messages are kept, tests play the other side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from gazelle.control.controller_node_interface import GoalPort, LiveParameter

__all__ = ["RecordedGoal", "RecordedPublisher", "RecordingPorts"]


@dataclass
class RecordedPublisher:
    """A topic: its type and what was sent."""

    type_name: str
    latch: bool = False
    matched: bool = True
    messages: list[Any] = field(default_factory=list)

    def publish(self, message: Any) -> None:
        """Keep the message; building one for nobody is a fault."""
        assert self.matched or self.latch, f"a {self.type_name} was built for nobody"
        self.messages.append(message)

    @property
    def last(self) -> Any:
        """The message sent last."""
        return self.messages[-1]


@dataclass
class RecordedGoal:
    """A goal as `GoalPort` describes it; `state` is new, active, succeeded, aborted …"""

    request: Any
    goal_id: str = "goal"
    state: str = "new"
    is_cancel_requested: bool = False
    is_feedback_wanted: bool = True
    result: Any = None
    text: str = ""
    feedback: list[Any] = field(default_factory=list)

    @property
    def is_active(self) -> bool:
        """True from accept to the end."""
        return self.state == "active"

    def accept(self) -> None:
        """Take it."""
        assert self.state == "new"
        self.state = "active"

    def reject(self, result: Any = None, text: str = "") -> None:
        """Do not take it."""
        assert self.state == "new"
        self._end("rejected", result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Keep what is told."""
        self.feedback.append(feedback)

    def succeed(self, result: Any = None, text: str = "") -> None:
        """End it well."""
        self._end("succeeded", result, text)

    def abort(self, result: Any = None, text: str = "") -> None:
        """End it badly."""
        self._end("aborted", result, text)

    def cancel(self, result: Any = None, text: str = "") -> None:
        """End it as wanted."""
        self._end("canceled", result, text)

    def _end(self, state: str, result: Any, text: str) -> None:
        assert self.state in {"new", "active"}, f"goal ended twice: {self.state}, then {state}"
        self.state, self.result, self.text = state, result, text


@dataclass
class _Live:
    values: dict[str, Any]
    rows: tuple[LiveParameter, ...]
    on_change: Callable[[dict[str, Any]], None]

    def update(self, values: Mapping[str, Any]) -> None:
        self.values.update(values)


@dataclass
class _Action:
    type_name: str
    on_goal: Callable[[GoalPort], None]
    on_cancel: Callable[[GoalPort], bool]


class RecordingPorts:
    """The `Ports` of a controller under test.

    Attributes:
        publishers, services, actions, live: what the controller offers, by name.
        subscriptions: callbacks by topic, with their types.
        lines: what it said, (level, text).
        subscribed: whether somebody listens to the topics offered from now on.
    """

    def __init__(self, *, subscribed: bool = True) -> None:
        self.subscribed = subscribed
        self.publishers: dict[str, RecordedPublisher] = {}
        self.subscriptions: dict[str, tuple[tuple[str, ...], Callable[[Any], None]]] = {}
        self.services: dict[str, tuple[str, Callable[[Any, Any], None]]] = {}
        self.actions: dict[str, _Action] = {}
        self.live: dict[str, _Live] = {}
        self.lines: list[tuple[str, str]] = []
        self.closed = False

    def publisher(
        self, topic: str, type_name: str, *, latch: bool = False, reliable: bool = True
    ) -> RecordedPublisher:
        """Offer a topic."""
        made = RecordedPublisher(type_name, latch, self.subscribed)
        self.publishers[topic] = made
        return made

    def subscription(
        self, topic: str, type_name: str | Sequence[str], callback: Callable[[Any], None]
    ) -> None:
        """Listen."""
        types = (type_name,) if isinstance(type_name, str) else tuple(type_name)
        self.subscriptions[topic] = (types, callback)

    def service(self, name: str, type_name: str, handler: Callable[[Any, Any], None]) -> None:
        """Answer."""
        self.services[name] = (type_name, handler)

    def action_server(
        self,
        name: str,
        type_name: str,
        *,
        on_goal: Callable[[GoalPort], None],
        on_cancel: Callable[[GoalPort], bool],
    ) -> None:
        """Offer an action."""
        self.actions[name] = _Action(type_name, on_goal, on_cancel)

    def live_parameters(
        self,
        group: str,
        parameters: Sequence[LiveParameter],
        on_change: Callable[[dict[str, Any]], None],
    ) -> _Live:
        """Offer live parameters."""
        made = _Live({row.name: row.value for row in parameters}, tuple(parameters), on_change)
        self.live[group] = made
        return made

    def log(self, level: str, text: str) -> None:
        """Keep what is said."""
        self.lines.append((level, text))

    def offer_parameters(
        self, values: Mapping[str, Any], on_set: Callable[[dict[str, Any]], str]
    ) -> None:
        """Take no notice: tests call `Controller.changed`."""

    def close(self) -> None:
        """Note it."""
        self.closed = True

    def send(self, topic: str, message: Any) -> None:
        """Publish to the controller, as another node would."""
        self.subscriptions[topic][1](message)

    def call(self, name: str, request: Any, response: Any) -> Any:
        """Call a service of the controller and return the response."""
        self.services[name][1](request, response)
        return response

    def send_goal(self, name: str, request: Any, goal_id: str = "goal") -> RecordedGoal:
        """Send a goal."""
        goal = RecordedGoal(request, goal_id)
        self.actions[name].on_goal(goal)
        return goal

    def cancel(self, name: str, goal: RecordedGoal) -> bool:
        """Ask to cancel a goal; tell whether the controller agrees."""
        goal.is_cancel_requested = True
        agreed = self.actions[name].on_cancel(goal)
        goal.is_cancel_requested = agreed
        return agreed

    def set_live(self, group: str, **values: Any) -> None:
        """Change live parameters, as rqt_reconfigure or ``ros2 param set`` would."""
        live = self.live[group]
        unknown = set(values) - set(live.values)
        assert not unknown, f"no live parameters {unknown}"
        live.values.update(values)
        live.on_change(dict(live.values))
