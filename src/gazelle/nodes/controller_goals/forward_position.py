"""``publisher_forward_position_controller``: one list of commands after another, for ever.

| name | default | meaning |
| --- | --- | --- |
| publish_topic | /position_commands | a topic of ``std_msgs/Float64MultiArray`` |
| wait_sec_between_publish | 5 | whole seconds between two, and before the first |
| goal_names | pos1, pos2 | parameters that hold one list each, in order |

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
from gazelle.nodes.controller_goals.parameters import GoalParameters, are_numbers, start
from gazelle.nodes.parameters import ticks

__all__ = ["read_goals", "run"]

_DEFAULTS: dict[str, Any] = {
    "publish_topic": "/position_commands",
    "wait_sec_between_publish": 5,
    "goal_names": ["pos1", "pos2"],
}


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Send until told to stop."""
    node, parameters = start(arguments, graph, _DEFAULTS)
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
