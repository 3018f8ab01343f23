"""The part of rclpy's `Node` that asks about the graph."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Any, NamedTuple

from gazelle.compat.rclpy.name_validation import (
    expand_topic_name,
    validate_full_topic_name,
    validate_topic_name,
)
from gazelle.compat.rclpy.qos import HistoryPolicy, QoSProfile, profile_of
from gazelle.graph import Entity, Graph, Kind, NodeInfo
from gazelle.graph import Node as GraphNode
from gazelle.graph.actions import actions_of
from gazelle.graph.key_expressions import entity_gid, token
from gazelle.graph.names import join, resolve, split

__all__ = ["GraphQueries", "TopicEndpointInfo", "TopicEndpointTypeEnum"]

NamesAndTypes = list[tuple[str, list[str]]]


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


class GraphQueries:
    """Lists of nodes, topics, services and actions."""

    graph_node: GraphNode

    def get_node_names(self) -> list[str]:
        """Return the nodes' own names."""
        return [name for name, _ in self.get_node_names_and_namespaces()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the nodes' global names."""
        return list(self._rcl_graph.node_names(include_hidden=True))

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the nodes' own names and namespaces."""
        found = (split(name) for name in self._rcl_graph.node_names(include_hidden=True))
        return [(name, namespace) for namespace, name in found]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """Return all topics; `no_demangle` changes nothing, as in rmw_zenoh."""
        topics = self._rcl_graph.topics(include_hidden=True)
        return [(one.name, [one.type_name]) for one in topics]

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return all services."""
        services = self._rcl_graph.services(include_hidden=True)
        return [(one.name, [one.type_name]) for one in services]

    def get_action_names_and_types(self) -> NamesAndTypes:
        """Return all actions of ROS 2."""
        found = actions_of(self._rcl_graph.entities())
        return [(one.name, [one.type_name]) for one in found if one.ros_version == 2]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node publishes; `no_demangle` changes nothing, as in rmw_zenoh."""
        return _pairs(self.__info(node_name, node_namespace).publications)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node subscribes; `no_demangle` changes nothing, as in rmw_zenoh."""
        return _pairs(self.__info(node_name, node_namespace).subscriptions)

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node answers."""
        return _pairs(self.__info(node_name, node_namespace).services)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node calls."""
        return _pairs(self.__info(node_name, node_namespace).clients)

    def count_publishers(self, topic_name: str) -> int:
        """Return how many publishers a topic has."""
        return len(
            self._rcl_graph.publishers_info(self.resolve_topic_name(topic_name, only_expand=True))
        )

    def count_subscribers(self, topic_name: str) -> int:
        """Return how many subscriptions a topic has."""
        return len(
            self._rcl_graph.subscriptions_info(
                self.resolve_topic_name(topic_name, only_expand=True)
            )
        )

    def count_clients(self, service_name: str) -> int:
        """Return how many clients a service has."""
        return self.__count(Kind.CLIENT, service_name)

    def count_services(self, service_name: str) -> int:
        """Return how many servers a service has."""
        return self.__count(Kind.SERVICE, service_name)

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return the nodes' own names, namespaces and enclaves, which are all ``/``."""
        return [(*one, "/") for one in self.get_node_names_and_namespaces()]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait until a node is there; False when `timeout` seconds pass first."""
        wanted = resolve(fully_qualified_node_name)

        def is_there(entities: Iterable[Entity]) -> bool:
            return any(one.kind is Kind.NODE and one.node == wanted for one in entities)

        return self._rcl_graph.discovery.wait_for(is_there, timeout)

    def get_publishers_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the publishers of a topic."""
        full = self.resolve_topic_name(topic_name)
        return [_endpoint(self._rcl_graph, one) for one in self._rcl_graph.publishers_info(full)]

    def get_subscriptions_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the subscriptions of a topic."""
        full = self.resolve_topic_name(topic_name)
        return [_endpoint(self._rcl_graph, one) for one in self._rcl_graph.subscriptions_info(full)]

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return a topic's global name, after remapping unless only expanded.

        Raises:
            InvalidTopicNameException: the name is not legal.
            ValueError: it has an unknown substitution.
        """
        return self._rcl_resolved(topic, only_expand=only_expand)

    def _rcl_resolved(
        self, name: str, *, only_expand: bool = False, is_service: bool = False
    ) -> str:
        validate_topic_name(name, is_service=is_service)
        namespace, own = split(self.graph_node.name)
        full = expand_topic_name(name, own, namespace)
        validate_full_topic_name(full, is_service=is_service)
        return full if only_expand else self.graph_node.resolve_name(full)

    @property
    def _rcl_graph(self) -> Graph:
        return self.graph_node.graph

    def __count(self, kind: Kind, name: str) -> int:
        full = self.resolve_topic_name(name, only_expand=True)
        return sum(one.kind is kind and one.name == full for one in self._rcl_graph.entities())

    def __info(self, name: str, namespace: str) -> NodeInfo:
        return self._rcl_graph.node_info(join(namespace or "/", name))


def _pairs(endpoints: Any) -> NamesAndTypes:
    return [(one.name, [one.type_name]) for one in endpoints]


def _endpoint(graph: Graph, one: Entity) -> TopicEndpointInfo:
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
