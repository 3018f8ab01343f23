"""Studio: the browser page's server, a client of the graph like any tool."""

from __future__ import annotations

from gazelle.studio.errors import StudioError
from gazelle.studio.params import Params
from gazelle.studio.server import Server
from gazelle.studio.session import Studio
from gazelle.studio.streams import Channel, Frame, OpenStream, StreamKind

__all__ = [
    "Channel",
    "Frame",
    "OpenStream",
    "Params",
    "Server",
    "StreamKind",
    "Studio",
    "StudioError",
]
