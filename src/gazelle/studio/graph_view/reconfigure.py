"""``reconfigure.*``: dynamic_reconfigure's parameters with their limits."""

from __future__ import annotations

import threading
from typing import Any, TypedDict

from gazelle.graph import Node
from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    ReconfigureClient,
    server_names,
)
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.request_params import Params

__all__ = [
    "DynamicClients",
    "DynamicGroupRow",
    "DynamicParameterRow",
    "Reconfigurable",
    "get_reconfigurable",
    "list_reconfigurable",
    "set_reconfigurable",
]

_TIMEOUT_S = 3.0


class DynamicParameterRow(TypedDict):
    """A parameter of dynamic_reconfigure.

    Attributes:
        edit_method: an object with `enum`, or null.
    """

    name: str
    type: str
    min: Any
    max: Any
    default: Any
    value: Any
    edit_method: Any
    description: str


class DynamicGroupRow(TypedDict):
    """A group of parameters."""

    name: str
    id: int
    parent: int
    type: str
    parameters: list[DynamicParameterRow]


class Reconfigurable(TypedDict):
    """What a node lets be changed."""

    groups: list[DynamicGroupRow]


def list_reconfigurable(node: Node, _params: Params) -> list[str]:
    """``reconfigure.list``."""
    return server_names(node.graph)


def get_reconfigurable(clients: DynamicClients, params: Params) -> Reconfigurable:
    """``reconfigure.get``: groups with the values of now."""
    client = clients.client(params)
    group, values = client.description, client.values
    assert group is not None
    return {"groups": _groups(group, values or {})}


def set_reconfigurable(clients: DynamicClients, params: Params) -> dict[str, Any]:
    """``reconfigure.set``: all values as they are afterwards."""
    client = clients.client(params)
    return dict(client.set(params.object("values"), timeout_s=_TIMEOUT_S))


class DynamicClients:
    """Clients that stay: descriptions and values come once, then with every change."""

    def __init__(self, node: Node) -> None:
        """Ask as `node`."""
        self._node = node
        self._lock = threading.Lock()
        self._made: dict[str, ReconfigureClient] = {}

    def client(self, params: Params) -> ReconfigureClient:
        """Return the client of the ``node`` that is named, which has told its values.

        Raises:
            StudioError: there is no such node, or it tells nothing.
        """
        name = self._node.resolve_name(params.text("node"))
        names = server_names(self._node.graph)
        if name not in names:
            self._forget(name)
            raise unknown("node with dynamic_reconfigure", name, names)
        with self._lock:
            made = self._made.get(name)
            if made is None:
                made = self._made[name] = ReconfigureClient(self._node, name)
        if made.wait_for_values(_TIMEOUT_S) is None:
            raise StudioError(f"{name} does not describe its parameters")
        return made

    def _forget(self, name: str) -> None:
        with self._lock:
            made = self._made.pop(name, None)
        if made is not None:
            made.close()


def _groups(top: DynamicGroup, values: dict[str, Any]) -> list[DynamicGroupRow]:
    return [
        {
            "name": group.name,
            "id": own,
            "parent": parent,
            "type": group.type,
            "parameters": [_row(one, values) for one in group.parameters],
        }
        for own, parent, group in top.numbered()
    ]


def _row(one: DynamicParameter, values: dict[str, Any]) -> DynamicParameterRow:
    return {
        "name": one.name,
        "type": one.type,
        "min": one.minimum,
        "max": one.maximum,
        "default": one.default,
        "value": values.get(one.name, one.default),
        "edit_method": _edit_method(one.edit_method),
        "description": one.description,
    }


def _edit_method(text: str) -> Any:
    """The enum that a description carries as Python's literal, as JSON; None for none."""
    import ast

    try:
        return ast.literal_eval(text) if text else None
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return None
