"""Quality of service on both sides, made to fit: ROS 2 itself would not connect what differs."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from gazelle.bridge.ros2.ros2_graph import RosEndpoint
from gazelle.graph.errors import coded

__all__ = ["QosProfile", "request_for", "widened"]

_FEW, _MANY = 20, 100


class QosProfile(NamedTuple):
    """A quality of service, as far as the bridge cares.

    Attributes:
        reliable: ``RELIABLE``, else ``BEST_EFFORT``.
        latched: ``TRANSIENT_LOCAL``, else ``VOLATILE``.
        depth: most messages that wait.
    """

    reliable: bool = True
    latched: bool = False
    depth: int = _FEW


def widened(
    node: str, topic: str, offered: QosProfile, asked: Iterable[RosEndpoint]
) -> tuple[QosProfile, dict[str, str]]:
    """Return what to offer in ROS for a publisher of the graph so that all who ask are served.

    Args:
        node: its node.
        topic: global name.
        offered: its own quality.
        asked: subscriptions of the topic in ROS.

    Returns:
        The quality, and by policy what to tell the user where it is more than was offered.
    """
    told: dict[str, str] = {}
    for one in asked:
        if one.reliable and not offered.reliable:
            told["RELIABILITY"] = _text(
                topic,
                f"{node} publishes best effort and {one.node} of ROS 2 asks for reliable",
                "the bridge sends reliably; set the subscription to best effort (sensor data)",
                "RELIABILITY",
            )
        if one.latched and not offered.latched:
            told["DURABILITY"] = _text(
                topic,
                f"{node} publishes volatile and {one.node} of ROS 2 asks for transient local",
                "the bridge keeps what passes; publish transient local (latched) or ask for "
                "volatile",
                "DURABILITY",
            )
    reliable = offered.reliable or "RELIABILITY" in told
    return QosProfile(reliable, offered.latched or "DURABILITY" in told, offered.depth), told


def request_for(topic: str, publishers: Iterable[RosEndpoint]) -> tuple[QosProfile, dict[str, str]]:
    """Return what to ask for in ROS so that every publisher of a topic is heard.

    Args:
        topic: global name.
        publishers: of the topic in ROS.

    Returns:
        The quality, and by policy what to tell the user where publishers differ.
    """
    found = tuple(publishers)
    told: dict[str, str] = {}
    latched = bool(found) and all(one.latched for one in found)
    if not latched and any(one.latched for one in found):
        told["DURABILITY"] = coded(
            "bridge.qos-mixed",
            f"topic {topic} has latched (transient local) publishers and others in ROS 2: "
            f"{', '.join(sorted(_durability(one) for one in found))}; what was latched before the "
            "bridge asked does not cross",
        )
    reliable = all(one.reliable for one in found)
    return QosProfile(reliable, latched, _MANY if latched else _FEW), told


def _durability(one: RosEndpoint) -> str:
    return f"{one.node} {'latched' if one.latched else 'volatile'}"


def _text(topic: str, what: str, fix: str, policy: str) -> str:
    return (
        coded("bridge.qos-adapted", f"topic {topic}: {what}; ROS 2 would not connect them", fix=fix)
        + f" {policy}"
    )
