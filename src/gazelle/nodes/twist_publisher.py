"""Publishing velocity commands, as ``Twist`` or ``TwistStamped``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["TwistPublisher"]


class TwistPublisher:
    """``cmd_vel`` as ``Twist``, or as ``TwistStamped`` where that is asked for.

    Attributes:
        publisher: of the topic.
    """

    def __init__(
        self,
        node: Node,
        *,
        is_stamped: bool,
        topic: str = "cmd_vel",
        frame_id: str = "base_link",
    ) -> None:
        """Offer the topic.

        Args:
            node: the owner.
            is_stamped: publish ``TwistStamped``.
            topic: its name.
            frame_id: of the header, where `publish` names none.
        """
        kind = "geometry_msgs/msg/TwistStamped" if is_stamped else "geometry_msgs/msg/Twist"
        self.publisher = node.create_publisher(topic, message_type(kind), queue_size=1)
        self._node = node
        self._is_stamped = is_stamped
        self._frame_id = frame_id

    def publish(
        self,
        x_m_s: float,
        y_m_s: float,
        yaw_rad_s: float,
        frame_id: str = "",
        *,
        z_m_s: float = 0.0,
    ) -> None:
        """Publish a velocity along x, y and z, and about z."""
        message: Any = self.publisher.message_class()
        twist = message.twist if self._is_stamped else message
        if self._is_stamped:
            set_header(message, self._node.clock.now_ns(), frame_id or self._frame_id)
        twist.linear.x, twist.linear.y, twist.linear.z = x_m_s, y_m_s, z_m_s
        twist.angular.z = yaw_rad_s
        self.publisher.publish(message)

    def stop(self) -> None:
        """Publish zero."""
        self.publish(0.0, 0.0, 0.0)

    def close(self) -> None:
        """Take the topic off the graph."""
        self.publisher.unregister()
