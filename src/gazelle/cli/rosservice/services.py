"""Which service a word means."""

from __future__ import annotations

from collections.abc import Collection

from gazelle.cli.tool import hint
from gazelle.graph import Graph, ServiceInfo
from gazelle.graph.gazebo_names import other_version_hint
from gazelle.graph.names import is_hidden

__all__ = ["find_service", "near_services", "service_hint"]


def find_service(graph: Graph, name: str) -> ServiceInfo | None:
    """Return the service of this global name, None when nobody offers it."""
    services = graph.services(include_hidden=True)
    return next((one for one in services if one.name == name), None)


def near_services(graph: Graph, name: str) -> str:
    """Return a line with what may have been meant, empty when nothing is known."""
    return service_hint(name, [one.name for one in graph.services(include_hidden=True)])


def service_hint(name: str, offered: Collection[str]) -> str:
    """Return a line with what does a service of ROS 1 here, or services spelled alike."""
    other = other_version_hint(name, offered)
    if other:
        return f"\n  {other}"
    return hint(name, [one for one in offered if is_hidden(name) or not is_hidden(one)])
