"""``turtles``: the canvas that turtlesim draws."""

from __future__ import annotations

from gazelle.studio.displays.cameras import open_picture
from gazelle.studio.displays.topic_display import DisplayContext, Site
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream

__all__ = ["open_turtles"]

_NODE = "/turtlesim"
_QUALITY = 92


def open_turtles(context: DisplayContext, channel: Channel, params: Params) -> OpenStream:
    """Stream ``turtles`` of a ``node``: its hidden topic ``~_canvas`` as pictures."""
    node = context.taps.node.resolve_name(params.text("node", _NODE))
    wanted = Params(params.where, {"topic": f"{node}/_canvas", "quality": _QUALITY})
    return open_picture(Site(context, channel, wanted))
