"""Nodes that do something by themselves and have a window beside: sliders and turtles."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace

from gazelle.graph import Graph
from gazelle.graph.names import resolve
from gazelle.nodes import joint_state_publisher as joints
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.turtlesim import simulator
from gazelle.studio.views.presence import SERVICE, Request, is_switched_off, present, say

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
    sources = [*arguments.params.get("source_list", ()), topic]
    extended = replace(arguments, params={**arguments.params, "source_list": sources})
    return _beside(joints.run, request, extended, graph, stop)


def turtlesim(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Let turtles draw, and show their canvas."""
    request = Request("turtlesim", {"node": arguments.name})
    return _beside(simulator.run, request, arguments, graph, stop)


def _wants_sliders(arguments: NodeArguments, graph: Graph) -> bool:
    """``use_gui`` is looked for where rospy's program does: ``~use_gui``, then ``use_gui``."""
    if "use_gui" in arguments.params:
        return bool(arguments.params["use_gui"])
    node = resolve(arguments.name, arguments.namespace)
    names = (f"{node}/use_gui", resolve("use_gui", arguments.namespace))
    found = next(filter(graph.parameters.has, names), None)
    return found is not None and bool(graph.parameters.get(found))


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
