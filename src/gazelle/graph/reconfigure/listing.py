"""Which nodes of a graph can be reconfigured."""

from __future__ import annotations

from gazelle.graph.graph import Graph

__all__ = ["server_names"]

_SUFFIX = "/set_parameters"


def server_names(graph: Graph) -> list[str]:
    """Return the names of all reconfigurable nodes and node handles.

    ROS 2's parameter services have the same name and another type; they are left out.
    """
    return sorted(
        service.name.removesuffix(_SUFFIX)
        for service in graph.services()
        if service.name.endswith(_SUFFIX) and "dynamic_reconfigure" in service.type_name
    )
