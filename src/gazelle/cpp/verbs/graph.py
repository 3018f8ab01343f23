"""Verbs of who and what is on the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.graph.key_expressions import ANY_TYPE, Entity, Kind, entity_gid, token

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []

_KINDS = {
    "publisher": Kind.PUBLISHER,
    "subscription": Kind.SUBSCRIPTION,
    "service": Kind.SERVICE,
    "client": Kind.CLIENT,
    "node": Kind.NODE,
}


@verb("graph/topics")
def topics(host: HostContext, request: dict[str, Any]) -> list[list[str]]:
    """Return names and types of all topics; types as ROS 1 writes them unless ``ros2``."""
    found = host.graph.topic_names_and_types(include_hidden=bool(request.get("hidden")))
    return [[name, _type(type_name, request)] for name, type_name in found]


@verb("graph/services")
def services(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return the names of all services."""
    found = host.graph.services(include_hidden=bool(request.get("hidden", True)))
    return [one.name for one in found]


@verb("graph/service_types")
def service_types(host: HostContext, request: dict[str, Any]) -> list[list[str]]:
    """Return names and types of all services."""
    found = host.graph.services(include_hidden=bool(request.get("hidden", True)))
    return [[one.name, _type(one.type_name, request)] for one in found]


@verb("graph/nodes")
def nodes(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return the global names of all nodes."""
    return list(host.graph.node_names(include_hidden=bool(request.get("hidden"))))


@verb("graph/ends")
def ends(host: HostContext, request: dict[str, Any]) -> list[dict[str, Any]]:
    """Return publishers, subscriptions, services, clients or nodes.

    The request's ``kind`` is one of these words in the singular; ``name`` restricts to a topic or
    service, ``node`` to a node; ``known`` asks nobody.
    """
    graph, kind = host.graph, _KINDS[request["kind"]]
    name, node = request.get("name"), request.get("node")
    found = graph.discovery.known() if request.get("known") else graph.entities()
    return [
        _end(one, graph.domain)
        for one in found
        if one.kind is kind
        and (name is None or one.name == name)
        and (node is None or one.node == node)
    ]


@verb("graph/count")
def count(host: HostContext, request: dict[str, Any]) -> int:
    """Return how many of a kind and name are known."""
    return host.graph.discovery.count(_KINDS[request["kind"]], request["name"])


@verb("graph/domain")
def domain(host: HostContext, request: dict[str, Any]) -> int:
    """Return ``ROS_DOMAIN_ID``."""
    del request
    return host.graph.domain


def _end(one: Entity, domain_id: int) -> dict[str, Any]:
    qos = one.qos
    return {
        "node": one.node,
        "name": one.name,
        "type": one.type_name,
        "hash": one.type_hash,
        "gid": entity_gid(token(domain_id, one)).hex(),
        "qos": {
            "depth": qos.depth,
            "reliable": qos.reliable,
            "latched": qos.latched,
            "deadline_ns": qos.deadline_ns,
            "lifespan_ns": qos.lifespan_ns,
            "manual": qos.manual,
            "lease_ns": qos.lease_ns,
        },
    }


def _type(name: str, request: dict[str, Any]) -> str:
    if request.get("ros2") or name == ANY_TYPE:
        return name
    from gazelle.interfaces import ros1_type_of

    return ros1_type_of(name)
