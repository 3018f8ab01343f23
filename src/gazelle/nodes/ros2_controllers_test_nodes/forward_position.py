"""``publisher_forward_position_controller``: one list of commands after another, for ever.

Names, defaults and texts are those of ``ros2_controllers_test_nodes`` (humble to rolling).
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from itertools import cycle
from typing import Any

from gazelle.errors import LaunchError
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import ticks
from gazelle.nodes.ros2_controllers_test_nodes.parameters import (
    GOAL,
    GoalParameters,
    are_numbers,
    start,
)
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "read_goals", "run"]

PARAMETERS = ParameterTable(
    "publisher_forward_position_controller",
    "Sends one list of commands after another to a forward controller, for ever. A value of another"
    " type than the default's ends it.",
    ("ros2_controllers_test_nodes/publisher_forward_position_controller",),
    (
        Parameter(
            "publish_topic", "text", "/position_commands", "a topic of `std_msgs/Float64MultiArray`"
        ),
        Parameter(
            "wait_sec_between_publish", "integer", 5, "between two, and before the first", "s"
        ),
        Parameter("goal_names", "texts", ["pos1", "pos2"], "parameters with a list each, in order"),
        Parameter(GOAL, "numbers", None, "such a list: a number for each joint"),
    ),
)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Send until told to stop."""
    node, parameters = start(arguments, graph, PARAMETERS)
    goals, topic = read_goals(parameters), parameters.value("publish_topic")
    kind: Any = message_type("std_msgs/msg/Float64MultiArray")
    publisher = node.create_publisher(topic, kind, queue_size=1)
    seconds = parameters.value("wait_sec_between_publish")
    node.log("info", f'Publishing {len(goals)} goals on topic "{topic}" every {seconds} s')
    arguments.ready()
    for goal, _now_ns in zip(cycle(goals), ticks(node, parameters.period_ns, stop), strict=False):
        # rclpy's message holds an array.array, and that is what the original prints.
        node.log("info", f"Publishing: \"array('d', {list(goal)})\"")
        publisher.publish(kind(data=list(goal)))
    node.shutdown()
    return 0


def read_goals(parameters: GoalParameters) -> list[Sequence[float]]:
    """Return the lists that are sent.

    Raises:
        LaunchError: one of them is no list of numbers.
    """
    goals: list[Sequence[float]] = []
    for name in parameters.goal_names:
        given = parameters.value(name)
        if given is None or given == []:
            raise LaunchError(
                f"Values for goal \"{name}\" not set! Give the node a parameter '{name}' with a "
                "list of numbers, one for each joint"
            )
        if not are_numbers(given):
            raise LaunchError(f"parameter '{name}' is {given!r}, not a list of numbers")
        goals.append([float(one) for one in given])
    return goals
