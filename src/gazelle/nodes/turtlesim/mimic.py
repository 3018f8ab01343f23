"""``mimic``: one turtle does what another one does (``input/pose`` to ``output/cmd_vel``).

``input`` and ``output`` can be remapped as namespaces, ``input:=turtlesim1/turtle1``, or the two
topics as a whole.
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Pass velocities on until told to stop."""
    node = start_node(arguments, graph)
    twist: Any = message_type("geometry_msgs/msg/Twist")
    source, target = node.resolve_name("input"), node.resolve_name("output")
    out = node.create_publisher(f"{target}/cmd_vel", twist, queue_size=1)

    def on_pose(pose: Any) -> None:
        message = twist()
        message.linear.x = pose.linear_velocity
        message.angular.z = pose.angular_velocity
        out.publish(message)

    node.create_subscription(f"{source}/pose", "turtlesim/msg/Pose", on_pose, queue_size=1)
    stop.wait()
    node.shutdown()
    return 0
