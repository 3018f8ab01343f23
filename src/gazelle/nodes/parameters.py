"""Starting a built-in node and reading its private parameters."""

from __future__ import annotations

from typing import Any

from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments

__all__ = ["private", "start_node"]


def start_node(arguments: NodeArguments, graph: Graph) -> Node:
    """Make the graph node of a built-in node, with its names and remaps."""
    node = graph.create_node(
        arguments.name, namespace=arguments.namespace, remappings=arguments.remappings
    )
    for name, value in arguments.params.items():
        node.parameters.set(node.resolve_name(f"~{name}"), value)
    return node


def private(node: Node, arguments: NodeArguments, name: str, default: Any) -> Any:
    """Return ``~name``: command line first, then the parameter store, then the default."""
    if name in arguments.params:
        return arguments.params[name]
    full = node.resolve_name(f"~{name}")
    return node.parameters.get(full) if node.parameters.has(full) else default
