"""Velocity commands of Nav2's servers, plain or stamped."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["VelocityOutput"]


class VelocityOutput:
    """``cmd_vel`` as ``Twist``, or as ``TwistStamped`` where that is asked for."""

    def __init__(self, node: Node, *, stamped: bool, topic: str = "cmd_vel") -> None:
        """Offer the topic."""
        self._node = node
        self._stamped = stamped
        kind = "geometry_msgs/msg/TwistStamped" if stamped else "geometry_msgs/msg/Twist"
        self._out = node.create_publisher(topic, message_type(kind), queue_size=1)

    def send(self, x: float, y: float, turn: float, frame: str = "base_link") -> None:
        """Send a velocity: m/s and rad/s."""
        message: Any = self._out.message_class()
        twist = message.twist if self._stamped else message
        if self._stamped:
            set_header(message, self._node.clock.now_ns(), frame)
        twist.linear.x, twist.linear.y, twist.angular.z = x, y, turn
        self._out.publish(message)

    def stop(self) -> None:
        """Send zero."""
        self.send(0.0, 0.0, 0.0)

    def close(self) -> None:
        """Take the topic off the graph."""
        self._out.unregister()
