"""Methods, streams and paths of panels of the user's own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.files import Route
from gazelle.studio.params import Params
from gazelle.studio.plugins.requests import (
    file_answer,
    list_panels,
    open_panel,
    port_panel,
    reload_panel,
    take_event,
)
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "ROUTES", "STREAMS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "plugin.event": take_event,
    "plugin.list": list_panels,
    "plugin.port": port_panel,
    "plugin.reload": reload_panel,
}
STREAMS: dict[str, StreamKind] = {"plugin": StreamKind(latest=False, open=open_panel)}
ROUTES: dict[str, Route] = {"plugin": file_answer}
