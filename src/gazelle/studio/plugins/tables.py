"""Methods, streams and paths of panels of the user's own."""

from __future__ import annotations

from gazelle.studio.plugins.methods import (
    file_answer,
    list_panels,
    open_panel,
    port_panel,
    reload_panel,
    take_event,
)
from gazelle.studio.plugins.shown_panels import Desk
from gazelle.studio.routing import Method, Route, methods_without
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "ROUTES", "STREAMS"]

METHODS: dict[str, Method[Desk]] = {
    "plugin.event": take_event,
    "plugin.list": list_panels,
    **methods_without({"plugin.port": port_panel}),
    "plugin.reload": reload_panel,
}
STREAMS: dict[str, StreamKind[Desk]] = {"plugin": StreamKind(latest=False, open=open_panel)}
ROUTES: dict[str, Route[Desk]] = {"plugin": file_answer}
