"""Who is connected to whom."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.bridge.foxglove.server_interface import Connections
from gazelle.graph import Entity, Kind
from gazelle.graph.names import is_hidden

__all__ = ["connections_of"]


def connections_of(entities: Iterable[Entity], own: str) -> Connections:
    """Return the nodes that publish, subscribe and answer, by topic and service.

    Args:
        entities: of the graph.
        own: the bridge's node, whose subscriptions are the viewers' and are left out.
    """
    found: dict[Kind, dict[str, set[str]]] = {
        kind: {} for kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.SERVICE)
    }
    for one in entities:
        is_own_ear = one.kind is Kind.SUBSCRIPTION and one.node == own
        if one.kind in found and not is_hidden(one.name) and not is_own_ear:
            found[one.kind].setdefault(one.name, set()).add(one.node)
    return Connections(*(_sorted(side) for side in found.values()))


def _sorted(side: dict[str, set[str]]) -> dict[str, tuple[str, ...]]:
    return {name: tuple(sorted(nodes)) for name, nodes in sorted(side.items())}
