"""All methods, streams and HTTP routes of the protocol, each with what does it.

A part of Studio that adds some keeps them in tables of its own and is named here; nothing is
registered by being imported.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.graph_view import tables as graph_view
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "STREAMS", "Method"]

Method = Callable[[Studio, Params], Any]

METHODS: dict[str, Method] = {**graph_view.METHODS}
STREAMS: dict[str, StreamKind] = {**graph_view.STREAMS}
