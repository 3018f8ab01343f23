"""Listings of the graph, made from its entities: what rostopic, rosnode and rosservice show."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from gazelle.graph.key_expressions import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden

__all__ = ["Endpoint", "NodeInfo", "ServiceInfo", "TopicInfo", "node_info", "nodes_of"]
__all__ += ["services_of", "topics_of"]


class TopicInfo(NamedTuple):
    """A topic and who uses it.

    Attributes:
        name: global name.
        type_name: ``pkg/msg/Name``; `ANY_TYPE` when only subscriptions of any type are there.
        publishers: global names of nodes, sorted, one per publisher.
        subscriptions: global names of nodes, sorted, one per subscription.
    """

    name: str
    type_name: str
    publishers: tuple[str, ...]
    subscriptions: tuple[str, ...]

    @property
    def n_publishers(self) -> int:
        """Number of publishers."""
        return len(self.publishers)

    @property
    def n_subscriptions(self) -> int:
        """Number of subscriptions."""
        return len(self.subscriptions)


class ServiceInfo(NamedTuple):
    """A service: global name, ``pkg/srv/Name``, and the nodes that answer it."""

    name: str
    type_name: str
    servers: tuple[str, ...]


class Endpoint(NamedTuple):
    """A topic or service as one node uses it: global name and type."""

    name: str
    type_name: str


class NodeInfo(NamedTuple):
    """A node and all it offers and uses, each list sorted by name.

    Attributes:
        name: global name.
        zid: the session it lives in.
        publications: topics it publishes.
        subscriptions: topics it subscribes.
        services: services it answers.
        clients: services it calls.
        pid: its process, 0 when it did not answer.
        host: the machine's name.
    """

    name: str
    zid: str
    publications: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]
    services: tuple[Endpoint, ...]
    clients: tuple[Endpoint, ...]
    pid: int = 0
    host: str = ""


def topics_of(entities: Iterable[Entity], *, include_hidden: bool = False) -> tuple[TopicInfo, ...]:
    """Return the topics by name."""
    publishers: dict[str, list[Entity]] = {}
    subscriptions: dict[str, list[Entity]] = {}
    for one in entities:
        if one.kind is Kind.PUBLISHER:
            publishers.setdefault(one.name, []).append(one)
        elif one.kind is Kind.SUBSCRIPTION:
            subscriptions.setdefault(one.name, []).append(one)
    found = []
    for name in sorted({*publishers, *subscriptions}):
        if is_hidden(name) and not include_hidden:
            continue
        offered, used = publishers.get(name, []), subscriptions.get(name, [])
        found.append(TopicInfo(name, _type_of([*offered, *used]), _nodes(offered), _nodes(used)))
    return tuple(found)


def services_of(
    entities: Iterable[Entity], *, include_hidden: bool = False
) -> tuple[ServiceInfo, ...]:
    """Return the services by name."""
    servers: dict[str, list[Entity]] = {}
    for one in entities:
        if one.kind is Kind.SERVICE and (include_hidden or not is_hidden(one.name)):
            servers.setdefault(one.name, []).append(one)
    return tuple(
        ServiceInfo(name, _type_of(offered), _nodes(offered))
        for name, offered in sorted(servers.items())
    )


def nodes_of(entities: Iterable[Entity], *, include_hidden: bool = False) -> tuple[str, ...]:
    """Return the global names of the nodes, sorted."""
    names = {one.node for one in entities if one.kind is Kind.NODE}
    return tuple(sorted(name for name in names if include_hidden or not is_hidden(name)))


def node_info(entities: Iterable[Entity], name: str) -> NodeInfo | None:
    """Return what is known of a node, None when there is none of the name."""
    own = [one for one in entities if one.node == name]
    tokens = [one for one in own if one.kind is Kind.NODE]
    if not tokens:
        return None
    return NodeInfo(
        name,
        tokens[-1].zid,
        _endpoints(own, Kind.PUBLISHER),
        _endpoints(own, Kind.SUBSCRIPTION),
        _endpoints(own, Kind.SERVICE),
        _endpoints(own, Kind.CLIENT),
    )


def _endpoints(entities: Iterable[Entity], kind: Kind) -> tuple[Endpoint, ...]:
    return tuple(
        sorted({Endpoint(one.name, one.type_name) for one in entities if one.kind is kind})
    )


def _nodes(entities: Iterable[Entity]) -> tuple[str, ...]:
    return tuple(sorted(one.node for one in entities))


def _type_of(entities: Iterable[Entity]) -> str:
    """The first type anybody states; publishers come first, and a type with a header.

    A drive of the simulator shows ``Twist`` and takes ``TwistStamped`` too; a bridge beside it
    that says the latter is the side that ROS sees.
    """
    stated = [one.type_name for one in entities if one.type_name != ANY_TYPE]
    if not stated:
        return ANY_TYPE
    return f"{stated[0]}Stamped" if f"{stated[0]}Stamped" in stated else stated[0]
