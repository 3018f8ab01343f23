"""dynamic_reconfigure's client side."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError
from gazelle.graph.dynamic_reconfigure.description import DynamicGroup, DynamicParameter, Value
from gazelle.graph.dynamic_reconfigure.messages import (
    config_message,
    enum_values,
    group_from_message,
    message_class,
    values_from_message,
)
from gazelle.graph.node import Node

__all__ = ["ReconfigureClient", "ReconfigureError"]

_TYPES: dict[str, type[Any]] = {"bool": bool, "int": int, "double": float, "str": str}
_TRUE = ("yes", "true", "t", "1")


class ReconfigureError(GazelleError):
    """A value cannot be set; the message says why."""


class ReconfigureClient:
    """Sees and changes the parameters of one server.

    Attributes:
        name: of the server, usually its node's.
        description: parameters and groups, None until they came.
        config: the last values as a message, None until they came.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        *,
        on_description: Callable[[DynamicGroup], None] | None = None,
        on_values: Callable[[Any, DynamicGroup], None] | None = None,
    ) -> None:
        """Listen to a server, which need not be there yet.

        Args:
            node: owns subscriptions and client.
            name: of the server.
            on_description: hears the description each time it comes.
            on_values: hears ``Config`` messages, with the description, once that has come.
        """
        from gazelle.interfaces import service_type

        self.name = node.resolve_name(name)
        self.description: DynamicGroup | None = None
        self.config: Any = None
        self._on_description, self._on_values = on_description, on_values
        self._arrived = threading.Condition()
        self._client = node.create_client(
            f"{self.name}/set_parameters", service_type("dynamic_reconfigure/Reconfigure")
        )
        self._descriptions = node.create_subscription(
            f"{self.name}/parameter_descriptions",
            message_class("ConfigDescription"),
            self._take_description,
        )
        self._updates = node.create_subscription(
            f"{self.name}/parameter_updates", message_class("Config"), self._take_values
        )

    @property
    def values(self) -> dict[str, Value] | None:
        """The last values by name, None until they came."""
        return None if self.config is None else values_from_message(self.config)

    def wait_for_server(self, timeout_s: float | None = None) -> bool:
        """Wait until the server can be called; tell whether it can."""
        return self._client.wait_for_service(timeout_s)

    def wait_for_description(self, timeout_s: float | None = None) -> DynamicGroup | None:
        """Return the description, None when it did not come in time."""
        with self._arrived:
            self._arrived.wait_for(lambda: self.description is not None, timeout_s)
        return self.description

    def wait_for_values(self, timeout_s: float | None = None) -> dict[str, Value] | None:
        """Return the values, None when they did not come in time."""
        with self._arrived:
            self._arrived.wait_for(lambda: None not in (self.description, self.config), timeout_s)
        return self.values

    def wait_for_change(self, timeout_s: float) -> None:
        """Wait until a description or values come, or the time is over."""
        with self._arrived:
            self._arrived.wait(timeout_s)

    def set(
        self,
        changes: Mapping[str, Any],
        *,
        states: Mapping[str, bool] | None = None,
        timeout_s: float | None = None,
    ) -> dict[str, Value]:
        """Change values and return all of them as the server has them then.

        Texts are read as the parameter's type wants: numbers, yes/true/t/1, names of an enum.

        Raises:
            ReconfigureError: a name is unknown, a value does not fit, or there is no description.
            ServiceUnavailableError, ServiceTimeoutError, ServiceCallError: the call failed.
        """
        group = self.wait_for_description(timeout_s)
        if group is None:
            raise ReconfigureError(f"'{self.name}' does not describe its parameters")
        rows = {row.name: row for row in group.every_parameter()}
        values = {name: converted(name, value, rows) for name, value in changes.items()}
        request = self._client.service_class.Request(config=config_message(group, values, states))
        if states is None:
            request.config.groups = []
        response = self._client.call(request, timeout_s)
        # A caller that looks at once must not see what was before.
        self.config = response.config
        return values_from_message(response.config)

    def close(self) -> None:
        """Stop listening."""
        self._descriptions.unregister()
        self._updates.unregister()
        self._client.unregister()

    def _take_description(self, message: Any) -> None:
        with self._arrived:
            is_first = self.description is None
            group = self.description = group_from_message(message)
            early = self.config if is_first else None
            self._arrived.notify_all()
        if self._on_description is not None:
            self._on_description(group)
        if self._on_values is not None and early is not None:
            self._on_values(early, group)

    def _take_values(self, message: Any) -> None:
        with self._arrived:
            self.config = message
            group = self.description
            self._arrived.notify_all()
        if self._on_values is not None and group is not None:
            self._on_values(message, group)


def converted(name: str, value: Any, rows: Mapping[str, DynamicParameter]) -> Value:
    """Return a value in a parameter's type.

    Raises:
        ReconfigureError: there is no such parameter, or the value does not fit.
    """
    row = rows.get(name)
    if row is None:
        hint = did_you_mean(name, rows)
        raise ReconfigureError(f"don't know parameter: {name}" + (f"; {hint}" if hint else ""))
    if isinstance(value, str):
        if row.type == "bool":
            return value.lower() in _TRUE
        named = {key.lower(): item for key, item in enum_values(row).items()}
        value = named.get(value.lower(), value)
    kind = _TYPES[row.type]
    try:
        result: Value = kind(value)
    except (TypeError, ValueError) as error:
        text = f"can't set parameter '{name}' of {kind}: {error}"
        raise ReconfigureError(text) from None
    return result
