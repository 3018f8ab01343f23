"""Which service a word means."""

from __future__ import annotations

from gazelle.cli.tool import hint
from gazelle.graph import Graph, ServiceInfo

__all__ = ["find_service", "near_services"]


def find_service(graph: Graph, name: str) -> ServiceInfo | None:
    """Return the service of this global name, None when nobody offers it."""
    services = graph.services(include_hidden=True)
    return next((one for one in services if one.name == name), None)


def near_services(graph: Graph, name: str) -> str:
    """Return a line with services spelled alike, empty when there are none."""
    return hint(name, [one.name for one in graph.services()])
