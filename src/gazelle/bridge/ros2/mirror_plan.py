"""What each side should have of the other: pure functions of both graphs."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from gazelle.bridge.ros2.qos import QosProfile
from gazelle.bridge.ros2.ros2_graph import RosState
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden, is_legal_base, split

__all__ = [
    "BRIDGE_NAME",
    "GraphEntities",
    "TopicOfNode",
    "TopicOfType",
    "crosses",
    "graph_entities_of",
]

BRIDGE_NAME = "/ros2_bridge"
_ALIAS = "_gazelle"
_ACTION = "/_action/"
_OWN_OF_EACH_NODE = "type_description_interfaces/"


class TopicOfNode(NamedTuple):
    """A topic as one node in ROS offers it for the graph.

    Attributes:
        node: its name in ROS.
        topic: global name.
        type_name: ``pkg/msg/Name``.
    """

    node: str
    topic: str
    type_name: str


class TopicOfType(NamedTuple):
    """A topic of one type that the graph wants from ROS."""

    topic: str
    type_name: str


class GraphEntities(NamedTuple):
    """All that the graph has for ROS and wants of it.

    Attributes:
        nodes: name in ROS by name on the graph.
        publishers: own quality by topic of a node.
        subscriptions: the node in ROS that asks, by topic and type.
        services: types by node in ROS and name.
    """

    nodes: dict[str, str]
    publishers: dict[TopicOfNode, QosProfile]
    subscriptions: dict[TopicOfType, str]
    services: dict[tuple[str, str], str]


def crosses(name: str, type_name: str) -> bool:
    """Return whether a topic or service is of use on the other side.

    Hidden names stay, but for those that actions are made of. So does the service with which each
    node tells its types.
    """
    if is_hidden(name) and _ACTION not in name:
        return False
    return not type_name.startswith(_OWN_OF_EACH_NODE)


def graph_entities_of(entities: Iterable[Entity], state: RosState) -> GraphEntities:
    """Return what the graph has for ROS and wants of it.

    Args:
        entities: of the graph, without those that come from ROS.
        state: of ROS; a node of the graph has another name there if its own is taken.
    """
    found = GraphEntities({}, {}, {}, {})
    taken = frozenset(state.nodes)
    for one in sorted(entities, key=lambda one: (one.node, one.name, one.type_name)):
        name = found.nodes.setdefault(one.node, _ros_name(one.node, taken))
        if one.kind is Kind.NODE or not crosses(one.name, one.type_name):
            continue
        if one.kind is Kind.PUBLISHER:
            _enter_publisher(found, name, one)
        elif one.kind is Kind.SUBSCRIPTION:
            _enter_subscription(found, name, one, state)
        elif one.kind is Kind.SERVICE:
            found.services[name, one.name] = one.type_name
    return found


def _enter_publisher(found: GraphEntities, name: str, one: Entity) -> None:
    key = TopicOfNode(name, one.name, one.type_name)
    own = QosProfile(one.qos.reliable, one.qos.latched, max(one.qos.depth, 1))
    before = found.publishers.get(key, own)
    found.publishers[key] = QosProfile(
        own.reliable or before.reliable,
        own.latched or before.latched,
        max(own.depth, before.depth),
    )


def _enter_subscription(found: GraphEntities, name: str, one: Entity, state: RosState) -> None:
    types = {one.type_name}
    if one.type_name == ANY_TYPE:
        types = {end.type_name for end in state.publishers if end.topic == one.name}
    for type_name in types:
        found.subscriptions.setdefault(TopicOfType(one.name, type_name), name)


def _ros_name(node: str, taken: frozenset[str]) -> str:
    if is_hidden(node) or not is_legal_base(split(node)[1]):
        return BRIDGE_NAME
    return f"{node}{_ALIAS}" if node in taken else node
