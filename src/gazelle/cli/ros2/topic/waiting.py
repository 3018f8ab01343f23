"""Which type a topic has, now or once somebody publishes it."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable

from gazelle.cli.ros2.graph import types_by_name
from gazelle.cli.tool import ToolError, hint
from gazelle.graph import Entity, Graph, Kind

__all__ = ["type_of_topic", "wait_for_type"]

_ENDS = (Kind.PUBLISHER, Kind.SUBSCRIPTION)
_LOOK_S = 0.5


def type_of_topic(graph: Graph, topic: str) -> str:
    """Return the type of a topic; when nobody has it, say so and return an empty text.

    Args:
        graph: the graph.
        topic: global name.

    Raises:
        ToolError: it has several types.
    """
    entities = graph.entities()
    found = _type(entities, topic)
    if not found:
        print(f"WARNING: topic [{topic}] does not appear to be published yet", flush=True)
        near = hint(topic, types_by_name(entities, _ENDS)).strip("\n")
        if near:
            print(near, file=sys.stderr, flush=True)
    return found


def wait_for_type(graph: Graph, topic: str, ended: threading.Event) -> str:
    """Return the type of a topic, once somebody has it; an empty text when the node has ended.

    Raises:
        ToolError: it has several types.
    """
    found = type_of_topic(graph, topic)
    while not found and not ended.is_set():
        graph.discovery.wait_for(lambda known: bool(_type(known, topic)), _LOOK_S)
        found = _type(graph.discovery.known(), topic)
    return found


def _type(entities: Iterable[Entity], topic: str) -> str:
    types = types_by_name(entities, _ENDS).get(topic, ())
    if len(types) > 1:
        raise ToolError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return types[0] if types else ""
