"""Verbs of services' ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.host.services import HostClient, HostServer
from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("service/offer")
def offer(host: HostContext, request: dict[str, Any]) -> Any:
    """Answer a service."""
    end = HostServer(host.core, host.node(request["node"]).node, request)
    return {"handle": host.add_end(end), "name": end.name}


@verb("service/client")
def client(host: HostContext, request: dict[str, Any]) -> Any:
    """Prepare calls of a service."""
    end = HostClient(host.node(request["node"]).node, request)
    return {"handle": host.add_end(end), "name": end.name}


@verb("service/is_ready")
def is_ready(host: HostContext, request: dict[str, Any]) -> bool:
    """Tell whether somebody offers a client's service."""
    found: HostClient = host.end(request["handle"])
    return found.is_ready


@verb("service/wait")
def wait(host: HostContext, request: dict[str, Any]) -> bool:
    """Wait until somebody offers a client's service."""
    found: HostClient = host.end(request["handle"])
    return found.wait(request["timeout_s"])


@verb("service/exists")
def exists(host: HostContext, request: dict[str, Any]) -> bool:
    """Tell whether somebody offers a service of a global name."""
    return host.graph.has_service(request["name"])
