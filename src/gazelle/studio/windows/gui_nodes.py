"""Nodes that do something by themselves and have a window beside: sliders and turtles."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.graph import Graph
from gazelle.graph.names import resolve
from gazelle.nodes import joint_state_publisher as joints
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.turtlesim import turtlesim_node
from gazelle.parameters.reader import flag_of
from gazelle.studio.windows.page_owner import SERVICE, Request, is_switched_off, present, say

__all__ = ["joint_state_publisher", "joint_state_publisher_gui", "turtlesim"]

# How long a node that shares its process leaves it to others to serve the page.
_OTHERS_FIRST_S = 3.0
_NodeFunction = Callable[[NodeArguments, Graph, threading.Event], int]


def joint_state_publisher(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish joint states; ``use_gui`` shows the sliders, as up to ROS Melodic."""
    if _wants_sliders(arguments, graph):
        graph.wait_for_service(SERVICE, 0 if is_switched_off() else _OTHERS_FIRST_S)
        return joint_state_publisher_gui(arguments, graph, stop)
    return joints.run(arguments, graph, stop)


def joint_state_publisher_gui(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish joint states, moved by the sliders of a panel."""
    topic = f"/_gazelle/sliders/{arguments.name}"
    request = Request("joint_state_publisher_gui", {"topic": topic, "publish": True})
    given = _own(arguments, graph, "source_list") or ()
    sources = [given] if isinstance(given, str) else list(given)
    extended = replace(arguments, params={**arguments.params, "source_list": [*sources, topic]})
    return _beside(joints.run, request, extended, graph, stop)


def turtlesim(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Let turtles draw, and show their canvas."""
    request = Request("turtlesim", {"node": arguments.name})
    return _beside(turtlesim_node.run, request, arguments, graph, stop)


def _wants_sliders(arguments: NodeArguments, graph: Graph) -> bool:
    """``use_gui`` is looked for where rospy's program does: ``~use_gui``, then ``use_gui``."""
    own = _own(arguments, graph, "use_gui")
    beside = resolve("use_gui", arguments.namespace)
    return bool(flag_of(graph.parameters.get(beside, False) if own is None else own))


def _own(arguments: NodeArguments, graph: Graph, name: str) -> Any:
    """Return what the command line or the store has at ``~name``, None where neither has it."""
    parameter = f"{resolve(arguments.name, arguments.namespace)}/{name}"
    return arguments.params.get(name, graph.parameters.get(parameter, None))


def _beside(
    run: _NodeFunction,
    request: Request,
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
) -> int:
    """Run a node, and in a thread beside it what shows its panel."""
    if not is_switched_off():
        # Out of `rosnode list`, where the document's turtle has no such neighbour.
        name = f"_{arguments.name}_window"
        window = graph.create_node(name, anonymous=True, rosout=False, is_ros2=True)
        showing = threading.Thread(
            target=present, args=(window, request, stop, say), name="panel", daemon=True
        )
        showing.start()
    return run(arguments, graph, stop)
