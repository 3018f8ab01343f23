"""Methods and streams of the graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.graph_view.echo import open_echo
from gazelle.studio.graph_view.publishing import publish
from gazelle.studio.graph_view.rosout import open_rosout
from gazelle.studio.graph_view.topology import get_graph, open_graph
from gazelle.studio.graph_view.types import get_type, list_types
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "STREAMS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "graph.get": get_graph,
    "topic.publish": publish,
    "type.get": get_type,
    "type.list": list_types,
}
STREAMS: dict[str, StreamKind] = {
    "graph": StreamKind(latest=False, open=open_graph),
    "rosout": StreamKind(latest=False, open=open_rosout),
    "topic.echo": StreamKind(latest=True, open=open_echo),
}
