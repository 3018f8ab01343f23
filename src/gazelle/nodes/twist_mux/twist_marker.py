"""``twist_mux twist_marker``: an arrow of a velocity, for RViz (``twist`` to ``marker``).

ROS 1's has no parameters; the defaults are its values.
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.nodes.twist_mux.parameters import USE_STAMPED, is_stamped
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "twist_marker",
    "Shows velocities as an arrow.",
    ("twist_mux/twist_marker",),
    (
        Parameter("scale", "number", 1.0, "of the arrow's shaft, which is 5 cm wide at 1"),
        Parameter("frame_id", "text", "base_footprint", "the arrow's frame"),
        Parameter("vertical_position", "number", 2.0, "how far above the frame it begins", "m"),
        USE_STAMPED,
    ),
)

_ARROW = 0


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show velocities until told to stop."""
    node = start_node(arguments, graph)
    marker: Any = message_type("visualization_msgs/msg/Marker")()
    point: Any = message_type("geometry_msgs/msg/Point")
    with private_parameters(node, arguments, PARAMETERS) as own:
        scale = own.number("scale")
        marker.header.frame_id = own.text("frame_id")
        marker.pose.position.z = own.number("vertical_position")
        stamped = is_stamped(own)
    marker.type = _ARROW
    marker.pose.orientation.w = 1.0
    marker.scale.x, marker.scale.y = 0.05 * scale, 0.1 * scale
    marker.color.a = marker.color.g = 1.0
    out = node.create_publisher("marker", type(marker), latch=True, queue_size=1)

    def show(message: Any) -> None:
        twist = message.twist if stamped else message
        aside, turn = twist.linear.y, twist.angular.z
        # An arrow without length is refused by RViz, so its tip is a little higher.
        tip = point(x=twist.linear.x, y=aside if abs(aside) > abs(turn) else turn, z=0.01)
        marker.points = [point(), tip]
        out.publish(marker)

    kind = f"geometry_msgs/msg/Twist{'Stamped' if stamped else ''}"
    node.create_subscription("twist", kind, show, queue_size=1)
    stop.wait()
    node.shutdown()
    return 0
