"""The display that a class means: Gazelle's own, or one that a pip package adds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple, TypedDict

from gazelle.diagnostics import did_you_mean
from gazelle.extensions import Extension, ExtensionGroup, load_extensions
from gazelle.studio.displays.display import Display, DisplayRow, display_row
from gazelle.studio.displays.registry import DISPLAYS, own_display
from gazelle.studio.request_params import Params

__all__ = ["Added", "AddedDisplays", "added_displays", "find_display", "list_added"]


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
