"""What a display of RViz is: a row of the table, as the server and the page need it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypedDict

from gazelle.studio.displays.topic_display import Site
from gazelle.studio.streams import OpenStream

__all__ = ["Display", "DisplayRow", "display_row"]


@dataclass(frozen=True)
class Display:
    """A class of RViz's displays.

    Attributes:
        name: the class without its package, as in ``Class: rviz_default_plugins/LaserScan``.
        about: one line about it.
        types: messages it shows, as ``sensor_msgs/LaserScan``; none for those without a topic.
        open: its stream ``display``; None for those that the page draws from other streams.
        aliases: what other versions of RViz call it.
        topic_names: RViz's properties, besides ``Topic``, that name its topic in a file.
        drawing: of Gazelle's own, the module below ``studio/src`` and the constant in it that
            draws it on the page.
        drawn_as: the display of the registry whose drawing it takes, empty for its own; only
            displays of other packages take another's.
        convert: of one that is drawn as another: makes its message into one that the other shows.
    """

    name: str
    about: str
    types: tuple[str, ...] = ()
    open: Callable[[Site], OpenStream] | None = None
    aliases: tuple[str, ...] = ()
    topic_names: tuple[str, ...] = ()
    drawing: str = ""
    drawn_as: str = ""
    convert: Callable[[Any], Any] | None = None


class DisplayRow(TypedDict):
    """What the page knows of a display before it draws one.

    Attributes:
        types: messages it shows, as `sensor_msgs/LaserScan`; none for those without a topic.
        aliases: what other versions of RViz call it.
        streams: it reads the stream `display`.
        drawn_as: the display whose drawing it takes, usually its own.
    """

    name: str
    about: str
    types: list[str]
    aliases: list[str]
    streams: bool
    drawn_as: str


def display_row(display: Display) -> DisplayRow:
    """Return a display as the page knows it."""
    return {
        "name": display.name,
        "about": display.about,
        "types": list(display.types),
        "aliases": list(display.aliases),
        "streams": display.open is not None,
        "drawn_as": display.drawn_as or display.name,
    }
