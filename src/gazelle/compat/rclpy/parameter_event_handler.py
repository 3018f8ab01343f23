"""Hearing of changed parameters (rclpy.parameter_event_handler)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.qos import QoSProfile, qos_profile_parameter_events
from gazelle.graph.names import resolve
from gazelle.interfaces import message_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "ParameterCallbackHandle",
    "ParameterEventCallbackHandle",
    "ParameterEventHandler",
]


@dataclass(frozen=True, eq=False, slots=True)
class ParameterCallbackHandle:
    """One callback of one parameter; `remove_parameter_callback` takes it."""

    parameter_name: str
    node_name: str
    callback: Callable[[Any], Any]


@dataclass(frozen=True, eq=False, slots=True)
class ParameterEventCallbackHandle:
    """One callback of all events; `remove_parameter_event_callback` takes it."""

    callback: Callable[[Any], Any]


class ParameterEventHandler:
    """Calls back when parameters of any node change; the last added callback comes first."""

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: CallbackGroup | None = None,
        **options: Any,
    ) -> None:
        self.node = node
        self.qos_profile = qos_profile
        self._callbacks: list[ParameterCallbackHandle] = []
        self._event_callbacks: list[ParameterEventCallbackHandle] = []
        self.parameter_event_subscription = node.create_subscription(
            message_type("rcl_interfaces/msg/ParameterEvent"),
            "/parameter_events",
            self._on_event,
            qos_profile,
            callback_group=callback_group,
            **options,
        )

    def destroy(self) -> None:
        """Hear of nothing more."""
        self.node.destroy_subscription(self.parameter_event_subscription)

    @staticmethod
    def get_parameters_from_event(event: Any) -> Iterator[Any]:
        """Return the new and changed parameters of an event."""
        yield from event.new_parameters
        yield from event.changed_parameters

    @classmethod
    def get_parameter_from_event(cls, event: Any, parameter_name: str, node_name: str) -> Any:
        """Return a node's parameter of an event, None when it is not in it."""
        found = cls.get_parameters_from_event(event) if event.node == node_name else ()
        return next((one for one in found if one.name == parameter_name), None)

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Any], Any]
    ) -> ParameterCallbackHandle:
        """Call back with a parameter's message when it changes.

        Args:
            parameter_name: the parameter.
            node_name: whose, relative to this node's namespace.
            callback: takes ``rcl_interfaces/msg/Parameter``.
        """
        full = resolve(node_name, self.node.get_namespace()) if node_name else self._own_name()
        handle = ParameterCallbackHandle(parameter_name, full, callback)
        self._callbacks.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Call back no more.

        Raises:
            RuntimeError: the callback is not there.
        """
        _remove(self._callbacks, handle)

    def add_parameter_event_callback(
        self, callback: Callable[[Any], Any]
    ) -> ParameterEventCallbackHandle:
        """Call back with every ``rcl_interfaces/msg/ParameterEvent``."""
        handle = ParameterEventCallbackHandle(callback)
        self._event_callbacks.insert(0, handle)
        return handle

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Call back no more.

        Raises:
            RuntimeError: the callback is not there.
        """
        _remove(self._event_callbacks, handle)

    def _own_name(self) -> str:
        return self.node.get_fully_qualified_name()

    def _on_event(self, event: Any) -> None:
        for handle in tuple(self._callbacks):
            found = self.get_parameter_from_event(event, handle.parameter_name, handle.node_name)
            if found is not None:
                handle.callback(found)
        for one in tuple(self._event_callbacks):
            one.callback(event)


def _remove(handles: list[Any], handle: Any) -> None:
    if handle not in handles:
        raise RuntimeError("Callback doesn't exist")
    handles.remove(handle)
