"""What is told of a publisher or subscription of a topic (rclpy.topic_endpoint_info)."""

from __future__ import annotations

import enum
from typing import NamedTuple

from gazelle.compat.rclpy.qos import HistoryPolicy, QoSProfile, profile_of
from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.key_expressions import entity_gid, token
from gazelle.graph.names import split

__all__ = ["TopicEndpointInfo", "TopicEndpointTypeEnum", "endpoint_info"]


class TopicEndpointTypeEnum(enum.IntEnum):
    """Which end of a topic is meant."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


class TopicEndpointInfo(NamedTuple):
    """A publisher or subscription of a topic."""

    node_name: str
    node_namespace: str
    topic_type: str
    topic_type_hash: str
    endpoint_type: TopicEndpointTypeEnum
    endpoint_gid: list[int]
    qos_profile: QoSProfile

    def __str__(self) -> str:
        qos = self.qos_profile
        depth = f" ({qos.depth})" if qos.history is HistoryPolicy.KEEP_LAST else ""
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                f"Topic type hash: {self.topic_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {'.'.join(f'{byte:02x}' for byte in self.endpoint_gid)}",
                "QoS profile:",
                f"  Reliability: {qos.reliability.name}",
                f"  History (Depth): {qos.history.name}{depth}",
                f"  Durability: {qos.durability.name}",
                f"  Lifespan: {qos.lifespan}",
                f"  Deadline: {qos.deadline}",
                f"  Liveliness: {qos.liveliness.name}",
                f"  Liveliness lease duration: {qos.liveliness_lease_duration}",
            ]
        )


def endpoint_info(graph: Graph, one: Entity) -> TopicEndpointInfo:
    """Return what is told of an entity, a publisher or a subscription."""
    namespace, name = split(one.node)
    is_publisher = one.kind is Kind.PUBLISHER
    return TopicEndpointInfo(
        name,
        namespace,
        one.type_name,
        one.type_hash,
        TopicEndpointTypeEnum.PUBLISHER if is_publisher else TopicEndpointTypeEnum.SUBSCRIPTION,
        list(entity_gid(token(graph.domain, one))),
        profile_of(one.qos),
    )
