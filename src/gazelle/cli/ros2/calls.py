"""Calls of one node's services, for the commands about lifecycles and components."""

from __future__ import annotations

from typing import Any

from gazelle.cli.ros2.graph import types_by_name
from gazelle.cli.tool import ToolError
from gazelle.errors import GraphError
from gazelle.graph import Entity, Kind, Node
from gazelle.graph.names import is_hidden
from gazelle.interfaces import service_type

__all__ = ["absolute", "call_service", "nodes_offering"]

_TIMEOUT_S = 10.0


def nodes_offering(
    entities: tuple[Entity, ...], services: dict[str, str], *, include_hidden: bool = False
) -> list[str]:
    """Return the nodes that offer all services, sorted.

    Args:
        entities: all of the graph.
        services: name below the node's own → type.
        include_hidden: hidden nodes too.
    """
    offered = types_by_name(entities, (Kind.SERVICE,))
    nodes = {one.node for one in entities if one.kind is Kind.NODE}
    return sorted(
        node
        for node in nodes
        if (include_hidden or not is_hidden(node))
        and all(kind in offered.get(f"{node}/{name}", ()) for name, kind in services.items())
    )


def call_service(node: Node, name: str, type_name: str, **fields: Any) -> Any:
    """Call a service once and return its response.

    Raises:
        ToolError: it fails, or there is no answer.
    """
    kind = service_type(type_name)
    try:
        return node.create_client(name, kind).call(kind.Request(**fields), timeout_s=_TIMEOUT_S)
    except GraphError as error:
        raise ToolError(str(error)) from None


def absolute(name: str) -> str:
    """Return a node's name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"
