"""Starting Nav2's nodes: parameters, simulated time, the states of a managed node."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.graph import Graph, Node
from gazelle.graph.ros2_node_parameters import NodeParameters
from gazelle.nodes.arguments import NodeArguments, file_params
from gazelle.nodes.lifecycle import Lifecycle
from gazelle.nodes.parameters import node_parameters, start_node
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = ["offer_parameters", "serve", "start", "tree_of_node"]

_POLL_S = 0.2


def start(arguments: NodeArguments, graph: Graph) -> tuple[Node, dict[str, Any]]:
    """Make the graph node; returns it and its parameters, nested, for `offer_parameters`."""
    node = start_node(arguments, graph, offers_parameters=False)
    tree = nested(arguments.params)
    if tree.get("use_sim_time") in (True, "true", "True"):
        node.clock.use(True)
    return node, tree


def tree_of_node(arguments: NodeArguments, full_name: str) -> dict[str, Any]:
    """Return the parameters of another node of the same process, nested."""
    return nested(file_params(arguments.parameter_files, full_name))


def offer_parameters(
    node: Node,
    tree: Mapping[str, Any],
    changed: Callable[[dict[str, Any]], str] = lambda changes: "",
) -> NodeParameters:
    """Offer a node's parameters to ``ros2 param``; `changed` may refuse with a reason."""
    values = {key: value for key, value in values_only(flattened(tree)) if value is not None}
    return node_parameters(node, values, changed, allow_undeclared=True)


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
