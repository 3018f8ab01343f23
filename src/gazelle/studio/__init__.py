"""Studio: the browser page's server, a client of the graph like any tool."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.studio.errors import StudioError
    from gazelle.studio.request_params import Params
    from gazelle.studio.server import Server
    from gazelle.studio.streams import Channel, Frame, OpenStream, StreamKind
    from gazelle.studio.studio import Studio

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

# Nodes with a window beside them import a module of this package in every launch; the server
# takes them a third of a second.
_PLACES = {
    "Channel": "gazelle.studio.streams",
    "Frame": "gazelle.studio.streams",
    "OpenStream": "gazelle.studio.streams",
    "Params": "gazelle.studio.request_params",
    "Server": "gazelle.studio.server",
    "StreamKind": "gazelle.studio.streams",
    "Studio": "gazelle.studio.studio",
    "StudioError": "gazelle.studio.errors",
}


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        from importlib import import_module

        return getattr(import_module(_PLACES[name]), name)
    raise AttributeError(f"module 'gazelle.studio' has no attribute '{name}'")
