"""dynamic_reconfigure's server side: two latched topics and ``set_parameters``."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from gazelle.graph.dynamic_reconfigure.description import DynamicGroup, DynamicParameter, Value
from gazelle.graph.dynamic_reconfigure.messages import (
    config_message,
    description_message,
    message_class,
    values_from_message,
)

__all__ = ["ReconfigureServer"]

_EVERYTHING = 0xFFFFFFFF


class _Closable(Protocol):
    def unregister(self) -> None: ...


class _Publisher(_Closable, Protocol):
    def publish(self, message: Any) -> None: ...


class _Store(Protocol):
    def get(self, name: str, default: Any = ..., /) -> Any: ...
    def set(self, name: str, value: Any, /) -> None: ...


class _Node(Protocol):
    @property
    def parameters(self) -> _Store: ...
    def create_publisher(
        self, topic: str, message_type: Any, *, latch: bool = False
    ) -> _Publisher: ...
    def create_service(
        self, name: str, service_type: Any, handler: Callable[[Any], Any]
    ) -> _Closable: ...
    def log(self, level: Any, text: str) -> None: ...


class ReconfigureServer:
    """Parameters that others can see and change.

    Attributes:
        group: what is offered.
        values: present values by name.
        states: of the groups, by name.
    """

    def __init__(
        self,
        node: _Node,
        namespace: str,
        group: DynamicGroup | Sequence[DynamicParameter],
        changed: Callable[[dict[str, Value], int], Mapping[str, Value] | None],
        *,
        reads_store: bool = True,
        calls_at_start: bool = False,
        run: Callable[[Callable[[], Any]], Any] | None = None,
    ) -> None:
        """Offer topics and service, and set the parameters in the store.

        Args:
            node: owns topics, service and parameters; of the graph or of the simulator.
            namespace: absolute, such as ``/depth_camera``.
            group: the parameters, or all of one group.
            changed: hears all values and the levels of those that changed; values it returns
                are taken in their place.
            reads_store: values that the parameter store has already are taken over.
            calls_at_start: `changed` is called once with every level, as ROS' servers do.
            run: runs a request's work, for example in the thread that owns the parameters;
                without it requests wait for each other.
        """
        self.group = (
            group if isinstance(group, DynamicGroup) else DynamicGroup("Default", (*group,))
        )
        self._rows = {row.name: row for row in self.group.every_parameter()}
        self._node = node
        self._namespace = namespace.rstrip("/")
        self._changed = changed
        self._stored: dict[str, Value] = {}
        self._lock = threading.RLock()
        self._run = run or self._run_alone
        self.states = {one.name: one.state for _, _, one in self.group.numbered()}
        self.values = {row.name: self._initial(row, reads_store) for row in self._rows.values()}
        descriptions = self._publisher("parameter_descriptions", "ConfigDescription")
        self._updates = self._publisher("parameter_updates", "Config")
        descriptions.publish(description_message(self.group))
        if calls_at_start:
            self._take(dict(self.values), _EVERYTHING)
        self._closables: list[_Closable] = [descriptions, self._updates, self._service()]
        self.announce()

    def announce(self) -> None:
        """Publish the present values and put those that changed into the parameter store."""
        for name, value in self.values.items():
            if name not in self._stored or self._stored[name] != value:
                self._node.parameters.set(f"{self._namespace}/{name}", value)
        self._stored = dict(self.values)
        self._updates.publish(self._config())

    def set(self, changes: Mapping[str, Any]) -> dict[str, Value]:
        """Change values as a request would; returns all values as they are then.

        Values beyond the limits are cut to them; names that are unknown or values of the wrong
        type are said on the console and left out.
        """
        with self._lock:
            wanted = dict(self.values)
            for name, value in changes.items():
                row = self._rows.get(name)
                if row is None or not row.accepts(value):
                    what = "is not one of its parameters" if row is None else f"is no {row.type}"
                    text = f"{self._namespace}: '{name}' = {value!r} {what}; it is left out"
                    self._node.log("warn", text)
                else:
                    wanted[name] = row.clamped(value)
            level = 0
            for name, row in self._rows.items():
                if wanted[name] != self.values[name]:
                    level |= row.level
            self._take(wanted, level)
            self.announce()
            return dict(self.values)

    def close(self) -> None:
        """Withdraw topics and service; closing twice does nothing."""
        while self._closables:
            self._closables.pop().unregister()

    def _take(self, values: dict[str, Value], level: int) -> None:
        self.values = values
        corrected = self._changed(values, level)
        if corrected is not None:
            for name, row in self._rows.items():
                value = corrected.get(name, self.values[name])
                self.values[name] = row.clamped(value) if row.accepts(value) else self.values[name]

    def _initial(self, row: DynamicParameter, reads_store: bool) -> Value:
        if reads_store:
            stored = self._node.parameters.get(f"{self._namespace}/{row.name}", row.default)
            if row.accepts(stored):
                return row.clamped(stored)
        # What a node begins with may lie beyond the limits, which only bound changes.
        return float(row.default) if row.type == "double" else row.default

    def _publisher(self, topic: str, kind: str) -> _Publisher:
        name = f"{self._namespace}/{topic}"
        return self._node.create_publisher(name, message_class(kind), latch=True)

    def _service(self) -> _Closable:
        from gazelle.interfaces import service_type

        service = service_type("dynamic_reconfigure/Reconfigure")

        def answer(request: Any) -> Any:
            response = service.Response()
            self._run(lambda: self._answer(request, response))
            return response

        return self._node.create_service(f"{self._namespace}/set_parameters", service, answer)

    def _answer(self, request: Any, response: Any) -> None:
        for item in request.config.groups:
            if item.name in self.states:
                self.states[item.name] = item.state
        self.set(values_from_message(request.config))
        response.config = self._config()

    def _config(self) -> Any:
        return config_message(self.group, self.values, self.states)

    def _run_alone(self, work: Callable[[], Any]) -> Any:
        with self._lock:
            return work()
