"""Starting a built-in node and reading its private parameters."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle.graph import Graph, Node, TimeJumpError, offer_loggers
from gazelle.graph.console import level_of
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters, ParameterPolicy
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.log_output import keep_log
from gazelle.nodes.ros2_console import print_ros2
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = [
    "node_parameters",
    "parameter_tree",
    "start_node",
    "ticks",
]

_SIM_TIME = "use_sim_time"


def start_node(arguments: NodeArguments, graph: Graph, *, offers_parameters: bool = True) -> Node:
    """Make the graph node of a built-in node, with its names and remaps.

    One of ROS 2 offers the parameters that it was started with; `node_parameters` says more.

    Args:
        arguments: of the command line.
        graph: takes the node.
        offers_parameters: whether it does; not where the node offers them by other means, since
            of two servers of one service any may answer.
    """
    ros2 = arguments.ros_version == 2
    with graph.announcements.together():
        node = graph.create_node(
            arguments.name,
            namespace=arguments.namespace,
            remappings=arguments.remappings,
            is_ros2=ros2,
        )
        # Its own threads may be at work when it is shut down.
        node.outlives = True
        if ros2:
            node.console = print_ros2
            if node.parameters.has(node.name):
                # In ROS 2 parameters end with their node; these are of one that had this name.
                node.parameters.delete(node.name)
            if offers_parameters:
                _offer_given(node, arguments.params)
        keep_log(node, arguments.log_file, arguments.output)
        offer_loggers(node)
    if arguments.log_level:
        node.log_level = level_of(arguments.log_level)
    for name, value in arguments.params.items():
        node.parameters.set(node.resolve_name(f"~{name}"), value)
    return node


def node_parameters(
    node: Node,
    values: Mapping[str, Any],
    on_set: Callable[[dict[str, Any]], str] = lambda changes: "",
    *,
    descriptors: Mapping[str, Descriptor] | None = None,
    allow_undeclared: bool = False,
) -> NodeParameters:
    """Offer the parameters of a built-in node to ``ros2 param``.

    Args:
        node: on the graph, started with ``offers_parameters=False``.
        values: by name, with dots.
        on_set: hears changes before they count; returns why they are refused, or nothing.
        descriptors: what is said about them.
        allow_undeclared: setting a name that is not declared declares it.
    """
    return NodeParameters(
        node,
        node.name,
        values,
        on_set,
        descriptors=descriptors,
        policy=ParameterPolicy(allow_undeclared=allow_undeclared),
        now_ns=node.clock.now_ns,
    )


def _offer_given(node: Node, given: Mapping[str, Any]) -> None:
    def refused(changes: dict[str, Any]) -> str:
        for name in changes:
            if name != _SIM_TIME:
                return (
                    f"parameter '{name}' is read when {node.name} starts; start it with "
                    f"-p {name}:=… or a file of parameters"
                )
        if _SIM_TIME in changes:
            node.clock.use(bool(changes[_SIM_TIME]))
        return ""

    values = {
        name: value for name, value in values_only(flattened(nested(given))) if value is not None
    }
    node_parameters(node, {_SIM_TIME: False, **values}, refused)


def parameter_tree(node: Node, arguments: NodeArguments) -> dict[str, Any]:
    """Return all parameters of a node, nested: the command line's over those of the store.

    A file of ROS 2 that was loaded into a node of ROS 1 counts by what it says, not by its heads.
    """
    stored = node.parameters.get(node.name, {}) or {}
    heads = [key for key, value in stored.items()
             if isinstance(value, dict) and "ros__parameters" in value]  # fmt: skip
    tree = nested({key: value for key, value in stored.items() if key not in heads})
    for key in heads:
        tree = {**nested(stored[key]["ros__parameters"] or {}), **tree}
    # What the command line says of a branch leaves the rest of it.
    return nested({**dict(flattened(tree)), **dict(flattened(nested(arguments.params)))})


def ticks(node: Node, period_ns: int, stop: threading.Event) -> Iterator[int]:
    """Yield the time at every period of the node's clock until told to stop.

    A period that is missed is not made up for; a jump back in time, also while the caller works,
    and a change to simulated time start anew from there.
    """
    jumps = node.clock.jumps
    next_ns = node.clock.now_ns() + period_ns
    while not stop.is_set():
        try:
            if not node.clock.sleep_until(next_ns, stop, since=jumps):
                return
        except TimeJumpError:
            jumps = node.clock.jumps
            next_ns = node.clock.now_ns() + period_ns
            continue
        now_ns = node.clock.now_ns()
        yield now_ns
        next_ns = max(next_ns, now_ns - period_ns) + period_ns
