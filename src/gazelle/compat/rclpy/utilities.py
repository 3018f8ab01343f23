"""Small functions of rclpy (rclpy.utilities, rclpy.wait_for_message)."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.context import get_default_context
from gazelle.compat.rclpy.init_shutdown import ok, shutdown, try_shutdown
from gazelle.compat.rclpy.publisher_subscription_service import RMW_IDENTIFIER
from gazelle.compat.rclpy.qos import QoSProfile, announced_qos, as_profile
from gazelle.graph.ros2_arguments import parse_ros_arguments

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "get_available_rmw_implementations",
    "get_default_context",
    "get_rmw_implementation_identifier",
    "ok",
    "remove_ros_args",
    "shutdown",
    "timeout_sec_to_nsec",
    "try_shutdown",
    "wait_for_message",
]


def get_rmw_implementation_identifier() -> str:
    """Return the name of the transport, which is that of ROS 2 over Zenoh."""
    return RMW_IDENTIFIER


def get_available_rmw_implementations() -> set[str]:
    """Return the names of all transports: the one there is."""
    return {get_rmw_implementation_identifier()}


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Return the arguments without ROS's own."""
    return parse_ros_arguments(sys.argv if args is None else args).rest


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Return a timeout in nanoseconds, -1 for none."""
    return -1 if timeout_sec is None or timeout_sec < 0 else int(float(timeout_sec) * 1e9)


def wait_for_message(
    msg_type: Any,
    node: Node,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Wait for the next message of a topic; return whether it came, and the message."""
    got: list[Any] = []
    arrived = threading.Event()

    def take(message: Any) -> None:
        got.append(message)
        arrived.set()

    qos = announced_qos(as_profile(qos_profile))
    full = node.resolve_topic_name(topic, only_expand=True)
    subscription = node.graph_node.create_subscription(full, msg_type, take, inline=True, qos=qos)
    deadline = None if time_to_wait < 0 else time.monotonic() + time_to_wait
    try:
        while node.context.ok() and not got:
            left_s = 0.1 if deadline is None else min(0.1, deadline - time.monotonic())
            if left_s <= 0:
                break
            arrived.wait(left_s)
    finally:
        subscription.unregister()
    return bool(got), got[0] if got else None
