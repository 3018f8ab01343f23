"""The part of rclpy's `Node` that asks about the graph."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from gazelle.compat.rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from gazelle.graph import Entity, Graph, Kind, NodeInfo
from gazelle.graph import Node as GraphNode
from gazelle.graph.actions import actions_of
from gazelle.graph.names import join, resolve, split

__all__ = ["GraphQueries", "TopicEndpointInfo"]

NamesAndTypes = list[tuple[str, list[str]]]


class TopicEndpointInfo(NamedTuple):
    """A publisher or subscription of a topic."""

    node_name: str
    node_namespace: str
    topic_type: str
    topic_type_hash: str
    endpoint_type: str
    qos_profile: QoSProfile


class GraphQueries:
    """Lists of nodes, topics, services and actions."""

    graph_node: GraphNode

    def get_node_names(self) -> list[str]:
        """Return the nodes' own names."""
        return [name for name, _ in self.get_node_names_and_namespaces()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the nodes' global names."""
        return list(self._graph.node_names(include_hidden=True))

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the nodes' own names and namespaces."""
        found = (split(name) for name in self._graph.node_names(include_hidden=True))
        return [(name, namespace) for namespace, name in found]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """Return all topics."""
        del no_demangle
        topics = self._graph.topics(include_hidden=True)
        return [(one.name, [one.type_name]) for one in topics]

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return all services."""
        services = self._graph.services(include_hidden=True)
        return [(one.name, [one.type_name]) for one in services]

    def get_action_names_and_types(self) -> NamesAndTypes:
        """Return all actions of ROS 2."""
        found = actions_of(self._graph.entities())
        return [(one.name, [one.type_name]) for one in found if one.generation == 2]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node publishes."""
        del no_demangle
        return _pairs(self._info(node_name, node_namespace).publications)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node subscribes."""
        del no_demangle
        return _pairs(self._info(node_name, node_namespace).subscriptions)

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node answers."""
        return _pairs(self._info(node_name, node_namespace).services)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node calls."""
        return _pairs(self._info(node_name, node_namespace).clients)

    def count_publishers(self, topic_name: str) -> int:
        """Return how many publishers a topic has."""
        return len(
            self._graph.publishers_info(self.resolve_topic_name(topic_name, only_expand=True))
        )

    def count_subscribers(self, topic_name: str) -> int:
        """Return how many subscriptions a topic has."""
        return len(
            self._graph.subscriptions_info(self.resolve_topic_name(topic_name, only_expand=True))
        )

    def count_clients(self, service_name: str) -> int:
        """Return how many clients a service has."""
        return self._count(Kind.CLIENT, service_name)

    def count_services(self, service_name: str) -> int:
        """Return how many servers a service has."""
        return self._count(Kind.SERVICE, service_name)

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return the nodes' own names, namespaces and enclaves, which are all ``/``."""
        return [(*one, "/") for one in self.get_node_names_and_namespaces()]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait until a node is there; False when `timeout` seconds pass first."""
        wanted = resolve(fully_qualified_node_name)

        def is_there(entities: Iterable[Entity]) -> bool:
            return any(one.kind is Kind.NODE and one.node == wanted for one in entities)

        return self._graph.discovery.wait_for(is_there, timeout)

    def get_publishers_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the publishers of a topic."""
        full = self.graph_node.resolve_name(topic_name)
        return [_endpoint(one, "PUBLISHER") for one in self._graph.publishers_info(full)]

    def get_subscriptions_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the subscriptions of a topic."""
        full = self.graph_node.resolve_name(topic_name)
        return [_endpoint(one, "SUBSCRIPTION") for one in self._graph.subscriptions_info(full)]

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return a topic's global name, after remapping unless only expanded."""
        if only_expand:
            return resolve(topic, self.graph_node.namespace, node=self.graph_node.name)
        return self.graph_node.resolve_name(topic)

    @property
    def _graph(self) -> Graph:
        return self.graph_node.graph

    def _count(self, kind: Kind, name: str) -> int:
        full = self.resolve_topic_name(name, only_expand=True)
        return sum(one.kind is kind and one.name == full for one in self._graph.entities())

    def _info(self, name: str, namespace: str) -> NodeInfo:
        return self._graph.node_info(join(namespace or "/", name))


def _pairs(endpoints: Any) -> NamesAndTypes:
    return [(one.name, [one.type_name]) for one in endpoints]


def _endpoint(entity: Entity, kind: str) -> TopicEndpointInfo:
    namespace, name = split(entity.node)
    latched, reliable = entity.qos.latched, entity.qos.reliable
    qos = QoSProfile(
        depth=entity.qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
    return TopicEndpointInfo(name, namespace, entity.type_name, entity.type_hash, kind, qos)
