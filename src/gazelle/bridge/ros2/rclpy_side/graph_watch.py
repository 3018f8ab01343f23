"""What there is in ROS besides the bridge itself, told whenever it changes."""

from __future__ import annotations

import time
from collections import Counter
from typing import Any

from .endpoints import Endpoints
from .pipes import Pipes

__all__ = ["Watch"]

_PERIOD_S = 0.25
_Row = list[Any]


class Watch:
    """Looks at ROS's graph a few times a second: rclpy tells nobody when it changes."""

    def __init__(self, pipes: Pipes, node: Any, endpoints: Endpoints) -> None:
        """Look at nothing yet."""
        self._pipes = pipes
        self._node = node
        self._endpoints = endpoints

    def run(self) -> None:
        """Look until the other half has gone.

        Raises:
            OSError: it has.
        """
        before: dict[str, list[_Row]] = {}
        news = self._endpoints.ros_publishers.news
        while True:
            started = time.monotonic()
            state = self._state()
            if state != before:
                self._pipes.send_control(report="state", **state)
                before = state
            # A large graph takes long to look at; most of the time is for messages.
            news.wait(max(_PERIOD_S, 4 * (time.monotonic() - started)))
            news.clear()

    def _state(self) -> dict[str, list[_Row]]:
        own = set(self._endpoints.own_names)
        counts = Counter(_full(*one) for one in self._node.get_node_names_and_namespaces())
        # A name of ours that is there twice is somebody else's too: ours gets another one.
        nodes = sorted(name for name, count in counts.items() if count > (name in own))
        publishers: list[_Row] = []
        subscriptions: list[_Row] = []
        for topic, _types in self._node.get_topic_names_and_types():
            for one, number in self._endpoints.ros_publishers.learn(topic):
                if number and _is_named(one):
                    publishers.append([*_row(one, topic), number])
            for one in self._node.get_subscriptions_info_by_topic(topic):
                if _is_named(one) and _full(one.node_name, one.node_namespace) not in own:
                    subscriptions.append(_row(one, topic))
        return {
            "nodes": [[name] for name in nodes],
            "publishers": sorted(publishers),
            "subscriptions": sorted(subscriptions),
            "services": sorted(
                row for name in nodes if name not in own for row in self._services(name)
            ),
        }

    def _services(self, full: str) -> list[_Row]:
        namespace, _, name = full.rpartition("/")
        try:
            found = self._node.get_service_names_and_types_by_node(name, namespace or "/")
        except Exception:  # noqa: BLE001 - rclpy's NodeNameNonExistentError, in many places
            # The node has gone since it was listed.
            return []
        return [[full, service, types[0]] for service, types in found if types]


def _row(one: Any, topic: str) -> _Row:
    qos = one.qos_profile
    node = _full(one.node_name, one.node_namespace)
    is_reliable = qos.reliability.name != "BEST_EFFORT"
    return [node, topic, one.topic_type, is_reliable, qos.durability.name == "TRANSIENT_LOCAL"]


def _is_named(one: Any) -> bool:
    """Whether ROS knows already whose it is; it learns that a moment after the topic."""
    return str(one.node_name) != "_NODE_NAME_UNKNOWN_"


def _full(name: str, namespace: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"
