"""All that ``ros2 doctor`` looks at, taken once."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.graph import Entity, Graph, NoGraphError
from gazelle.workspace import Workspace

__all__ = ["Sight", "look"]


class Sight(NamedTuple):
    """What was seen.

    Attributes:
        entities: of the graph.
        port: the graph's port, 0 when there is no graph.
        trouble: why there is no graph.
        workspace: None when packages are not looked at.
    """

    entities: tuple[Entity, ...] = ()
    port: int = 0
    trouble: str = ""
    workspace: Workspace | None = None


def look(*, with_packages: bool) -> Sight:
    """Look at the graph, if there is one, and at the packages."""
    workspace = Workspace.discover() if with_packages else None
    try:
        with Graph.open(role="client") as graph:
            return Sight(graph.entities(), graph.port, workspace=workspace)
    except NoGraphError as error:
        return Sight(trouble=str(error).partition(" (")[0], workspace=workspace)
