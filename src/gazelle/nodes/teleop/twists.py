"""Sending ``Twist`` or ``TwistStamped`` on ``cmd_vel``."""

from __future__ import annotations

from typing import Any

from gazelle.graph import Node, Publisher
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp

__all__ = ["TwistSender", "twist_sender"]


class TwistSender:
    """Sends velocities.

    Attributes:
        publisher: of the topic.
    """

    def __init__(self, publisher: Publisher, node: Node, frame_id: str | None) -> None:
        """Use `twist_sender`."""
        self.publisher = publisher
        self._node = node
        self._frame_id = frame_id

    def __call__(self, linear_m_s: tuple[float, float, float], angular_rad_s: float) -> None:
        """Send velocities along x, y and z, and about z."""
        message = self.publisher.message_class()
        twist = message
        if self._frame_id is not None:
            now_ns = self._node.clock.now_ns()
            message.header.frame_id = self._frame_id
            set_stamp(message.header.stamp, now_ns)
            twist = message.twist
        twist.linear.x, twist.linear.y, twist.linear.z = linear_m_s
        twist.angular.z = angular_rad_s
        self.publisher.publish(message)


def twist_sender(node: Node, *, is_stamped: bool, frame_id: str = "") -> TwistSender:
    """Offer ``cmd_vel``.

    Args:
        node: of the program.
        is_stamped: send ``TwistStamped``.
        frame_id: of its header.
    """
    name = "TwistStamped" if is_stamped else "Twist"
    kind: Any = message_type(f"geometry_msgs/msg/{name}")
    publisher = node.create_publisher("cmd_vel", kind, queue_size=1)
    return TwistSender(publisher, node, frame_id if is_stamped else None)
