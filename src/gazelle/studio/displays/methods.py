"""The streams that show messages, and which display a class of RViz means.

It is Gazelle's own, or one that a pip package adds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple, TypedDict

from gazelle.diagnostics import did_you_mean
from gazelle.extensions import Extension, ExtensionGroup, load_extensions
from gazelle.studio.displays.cameras import open_image, open_turtles
from gazelle.studio.displays.display import Display, DisplayRow, display_row
from gazelle.studio.displays.registry import DISPLAYS, own_display
from gazelle.studio.displays.topic_display import DisplayContext, Site, open_on
from gazelle.studio.errors import unknown
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method, methods_without
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = [
    "METHODS",
    "STREAMS",
    "Added",
    "AddedDisplays",
    "added_displays",
    "find_display",
    "list_added",
]


class Added(NamedTuple):
    """What pip packages add.

    Attributes:
        displays: by name; each has what opens it.
        problems: one sentence for each that cannot be shown.
    """

    displays: dict[str, Display]
    problems: tuple[str, ...]


class AddedDisplays(TypedDict):
    """Displays that pip packages add, and one sentence for each that cannot be shown."""

    displays: list[DisplayRow]
    problems: list[str]


def find_display(name: str) -> Display | None:
    """Return the display that a class means: ``rviz/LaserScan``, or only ``LaserScan``."""
    short = name.rpartition("/")[2]
    return own_display(short) or next(
        (one for one in added_displays().displays.values() if short in (one.name, *one.aliases)),
        None,
    )


def added_displays() -> Added:
    """Return the displays of pip packages; they are imported by that."""
    found = load_extensions(ExtensionGroup.DISPLAYS, Display)
    displays: dict[str, Display] = {}
    problems = list(found.problems)
    for extension in found.parts:
        display = extension.part
        if problem := next(_problems(extension, displays), ""):
            problems.append(f"{extension.origin} {problem}")
            continue
        opener = display.open or DISPLAYS[display.drawn_as].open
        displays[display.name] = replace(display, open=opener)
    return Added(displays, tuple(problems))


def list_added(_params: Params) -> AddedDisplays:
    """``display.list``."""
    added = added_displays()
    rows = [display_row(display) for display in added.displays.values()]
    return {"displays": rows, "problems": list(added.problems)}


def _open_display(context: DisplayContext, channel: Channel, params: Params) -> OpenStream:
    name = params.text("display").rpartition("/")[2]
    display = find_display(name)
    if display is None or display.open is None:
        added = added_displays()
        known = (row.name for row in (*DISPLAYS.values(), *added.displays.values()) if row.open)
        raise unknown("display", name, known, hint=" ".join(added.problems))
    return open_on(Site(context, channel, params, display.convert), display.open)


def _problems(extension: Extension[Display], earlier: dict[str, Display]) -> Iterator[str]:
    display = extension.part
    for name in (display.name, *display.aliases):
        if own_display(name):
            yield f"adds the display '{name}', which Gazelle has itself"
    if display.name in earlier:
        yield f"adds the display '{display.name}', which another package adds, too"
    if not display.types:
        yield f"adds the display '{display.name}', which shows no type of message"
    streamed = [name for name, one in DISPLAYS.items() if one.open is not None]
    if display.drawn_as not in streamed:
        what = f"as '{display.drawn_as}'" if display.drawn_as else "as none of them"
        hint = did_you_mean(display.drawn_as, streamed)
        yield (
            f"adds the display '{display.name}', drawn {what}, which is none of Gazelle's displays "
            f"with a topic{f'; {hint}' if hint else ''}"
        )


METHODS: dict[str, Method[object]] = methods_without({"display.list": list_added})
STREAMS: dict[str, StreamKind[DisplayContext]] = {
    "display": StreamKind(latest=True, open=_open_display),
    "image": StreamKind(latest=True, open=open_image),
    "turtles": StreamKind(latest=True, open=open_turtles),
}
