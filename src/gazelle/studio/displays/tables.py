"""The streams that show messages, and the displays that pip packages add."""

from __future__ import annotations

from gazelle.studio.displays.cameras import open_image
from gazelle.studio.displays.finding import added_displays, find_display, list_added
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.displays.topic_display import DisplayContext, Site, open_on
from gazelle.studio.displays.turtles import open_turtles
from gazelle.studio.errors import unknown
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method, methods_without
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["METHODS", "STREAMS"]


def _open_display(context: DisplayContext, channel: Channel, params: Params) -> OpenStream:
    name = params.text("display").rpartition("/")[2]
    display = find_display(name)
    if display is None or display.open is None:
        added = added_displays()
        known = (row.name for row in (*DISPLAYS.values(), *added.displays.values()) if row.open)
        raise unknown("display", name, known, hint=" ".join(added.problems))
    return open_on(Site(context, channel, params, display.convert), display.open)


METHODS: dict[str, Method[object]] = methods_without({"display.list": list_added})
STREAMS: dict[str, StreamKind[DisplayContext]] = {
    "display": StreamKind(latest=True, open=_open_display),
    "image": StreamKind(latest=True, open=open_image),
    "turtles": StreamKind(latest=True, open=open_turtles),
}
