"""The streams that show messages."""

from __future__ import annotations

from gazelle.studio.displays.cameras import open_image
from gazelle.studio.displays.registry import DISPLAYS, find_display
from gazelle.studio.displays.showing import Site, open_on
from gazelle.studio.displays.turtles import open_turtles
from gazelle.studio.errors import unknown
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["STREAMS"]


def _open_display(studio: Studio, channel: Channel, params: Params) -> OpenStream:
    name = params.text("display").rpartition("/")[2]
    display = find_display(name)
    if display is None or display.open is None:
        raise unknown("display", name, (row.name for row in DISPLAYS.values() if row.open))
    return open_on(Site(studio, channel, params), display.open)


STREAMS: dict[str, StreamKind] = {
    "display": StreamKind(latest=True, open=_open_display),
    "image": StreamKind(latest=True, open=open_image),
    "turtles": StreamKind(latest=True, open=open_turtles),
}
