"""How fast the robot drives, from odometry."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Odometry"]

_STALE_NS = 1_000_000_000


class Odometry:
    """The last message of an odometry topic.

    Attributes:
        velocity: along x and y of the robot (m/s) and around z (rad/s).
    """

    def __init__(self, node: Node, topic: str = "odom") -> None:
        """Start to listen; the robot stands until the first message."""
        self.velocity = (0.0, 0.0, 0.0)
        self._node = node
        self._heard_ns: int | None = None
        self._subscription = node.create_subscription(
            topic, "nav_msgs/msg/Odometry", self._on_odometry, queue_size=1
        )

    @property
    def topic(self) -> str:
        """The topic's global name."""
        return self._subscription.topic

    @property
    def is_silent(self) -> bool:
        """True before the first message, and a second after the last one."""
        now_ns = self._node.clock.now_ns()
        return self._heard_ns is None or now_ns - self._heard_ns > _STALE_NS

    @property
    def speed_m_s(self) -> float:
        """Speed over ground."""
        return math.hypot(self.velocity[0], self.velocity[1])

    def close(self) -> None:
        """Listen no more."""
        self._subscription.unregister()

    def _on_odometry(self, message: Any) -> None:
        twist = message.twist.twist
        velocity = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(map(math.isfinite, velocity)):
            self.velocity = velocity
            self._heard_ns = self._node.clock.now_ns()
