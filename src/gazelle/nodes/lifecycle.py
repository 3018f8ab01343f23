"""The lifecycle of ROS 2's managed nodes, for built-in ones (design.ros2.org: Managed nodes)."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.arguments import NodeArguments

__all__ = ["Lifecycle", "serve"]

_STATES = {0: "unknown", 1: "unconfigured", 2: "inactive", 3: "active", 4: "finalized"}
_UNCONFIGURED, _INACTIVE, _ACTIVE, _FINALIZED = 1, 2, 3, 4
_POLL_S = 0.2


class _Transition(NamedTuple):
    id: int
    label: str
    start: int
    goal: int


_TRANSITIONS = (
    _Transition(1, "configure", _UNCONFIGURED, _INACTIVE),
    _Transition(2, "cleanup", _INACTIVE, _UNCONFIGURED),
    _Transition(3, "activate", _INACTIVE, _ACTIVE),
    _Transition(4, "deactivate", _ACTIVE, _INACTIVE),
    _Transition(5, "shutdown", _UNCONFIGURED, _FINALIZED),
    _Transition(6, "shutdown", _INACTIVE, _FINALIZED),
    _Transition(7, "shutdown", _ACTIVE, _FINALIZED),
)


class Lifecycle:
    """States that others change by services.

    Attributes:
        callbacks: what is done on ``configure``, ``activate``, ``deactivate``, ``cleanup``,
            ``shutdown``; false, or an exception, leaves the state as it was.
    """

    def __init__(self, node: Node, callbacks: dict[str, Callable[[], bool]]) -> None:
        """Offer the services of a managed node, unconfigured."""
        self.callbacks = callbacks
        self._node = node
        self._state = _UNCONFIGURED
        self._lock = threading.Lock()
        event: Any = message_type("lifecycle_msgs/msg/TransitionEvent")
        with node.announced_together():
            self._events = node.create_publisher("~/transition_event", event)
            for name, kind, answer in (
                ("change_state", "ChangeState", self._on_change),
                ("get_state", "GetState", self._on_get),
                ("get_available_states", "GetAvailableStates", self._on_states),
                ("get_available_transitions", "GetAvailableTransitions", self._on_available),
                ("get_transition_graph", "GetAvailableTransitions", self._on_graph),
            ):
                node.create_service(f"~/{name}", service_type(f"lifecycle_msgs/srv/{kind}"), answer)

    @property
    def active(self) -> bool:
        """Whether the node does its work."""
        return self._state == _ACTIVE

    @property
    def finalized(self) -> bool:
        """Whether the node has ended."""
        return self._state == _FINALIZED

    def change(self, wanted: int | str) -> bool:
        """Take a transition by its number or name; tells whether that went well."""
        with self._lock:
            found = next(
                (
                    one
                    for one in _TRANSITIONS
                    if one.start == self._state and wanted in (one.id, one.label)
                ),
                None,
            )
            if found is None:
                self._node.log(
                    "error",
                    f"Unable to start transition {wanted} from current state "
                    f"{_STATES[self._state]}; possible: "
                    + (", ".join(one.label for one in self._available()) or "none"),
                )
                return False
            if not self._done(found.label):
                return False
            self._state = found.goal
            self._tell(found)
            return True

    def _done(self, label: str) -> bool:
        callback = self.callbacks.get(label)
        if callback is None:
            return True
        try:
            return bool(callback())
        except Exception as error:  # noqa: BLE001 - whatever goes wrong, the node stays up
            self._node.log("error", f"{label} failed: {error}")
            return False

    def _tell(self, found: _Transition) -> None:
        event = message_type("lifecycle_msgs/msg/TransitionEvent")()
        event.transition = _transition(found)
        event.start_state, event.goal_state = _state(found.start), _state(found.goal)
        self._events.publish(event)

    def _available(self) -> list[_Transition]:
        return [one for one in _TRANSITIONS if one.start == self._state]

    def _on_change(self, request: Any) -> Any:
        wanted = request.transition.label or int(request.transition.id)
        kind = service_type("lifecycle_msgs/srv/ChangeState")
        return kind.Response(success=self.change(wanted))

    def _on_get(self, _request: Any) -> Any:
        kind = service_type("lifecycle_msgs/srv/GetState")
        return kind.Response(current_state=_state(self._state))

    def _on_states(self, _request: Any) -> Any:
        kind = service_type("lifecycle_msgs/srv/GetAvailableStates")
        return kind.Response(available_states=[_state(number) for number in _STATES])

    def _on_available(self, _request: Any) -> Any:
        return _descriptions(self._available())

    def _on_graph(self, _request: Any) -> Any:
        return _descriptions(list(_TRANSITIONS))


def serve(
    arguments: NodeArguments,
    node: Node,
    stop: threading.Event,
    callbacks: dict[str, Callable[[], bool]],
) -> Lifecycle:
    """Be a managed node until told to stop, or until it is finalized.

    Args:
        arguments: of the node.
        node: on the graph.
        stop: told to stop.
        callbacks: see `Lifecycle`.
    """
    lifecycle = Lifecycle(node, callbacks)
    arguments.ready()
    while not (stop.wait(_POLL_S) or lifecycle.finalized or node.closed):
        pass
    if not node.closed and lifecycle.active:
        lifecycle.change("deactivate")
    return lifecycle


def _state(number: int) -> Any:
    return message_type("lifecycle_msgs/msg/State")(id=number, label=_STATES[number])


def _transition(one: _Transition) -> Any:
    return message_type("lifecycle_msgs/msg/Transition")(id=one.id, label=one.label)


def _descriptions(transitions: list[_Transition]) -> Any:
    kind = message_type("lifecycle_msgs/msg/TransitionDescription")
    made = [
        kind(
            transition=_transition(one), start_state=_state(one.start), goal_state=_state(one.goal)
        )
        for one in transitions
    ]
    service = service_type("lifecycle_msgs/srv/GetAvailableTransitions")
    return service.Response(available_transitions=made)
