"""Verbs of topics' ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.host.topics import HostPublisher, HostSubscription
from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("topic/advertise")
def advertise(host: HostContext, request: dict[str, Any]) -> Any:
    """Offer a topic."""
    node = host.node(request["node"]).node
    end = HostPublisher(host.core, node, request)
    number = host.add_end(end)
    end.begin()
    return {
        "handle": number,
        "topic": end.topic,
        "type": end.type_name,
        "gid": end.gid.hex(),
    }


@verb("topic/subscribe")
def subscribe(host: HostContext, request: dict[str, Any]) -> Any:
    """Receive a topic."""
    node = host.node(request["node"]).node
    end = HostSubscription(host.core, node, request)
    number = host.add_end(end)
    end.begin()
    return {"handle": number, "topic": end.topic}


@verb("topic/refuse")
def refuse(host: HostContext, request: dict[str, Any]) -> None:
    """Say that a publisher of this process has another type than a subscription."""
    from gazelle.graph.errors import coded

    one = host.node(request["node"])
    name = getattr(one.node, "name", "")
    text = (
        f"{name} wants topic {request['topic']} to have type {request['wanted']}, but it is "
        f"published as {request['type']}; those messages are dropped"
    )
    host.log(request["node"], 40, coded("graph.type-mismatch", text), "", ("", 0, ""))


@verb("end/close")
def close(host: HostContext, request: dict[str, Any]) -> None:
    """Take a publisher, subscription, server or client off the graph."""
    host.drop_end(request["handle"])
