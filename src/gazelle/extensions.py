"""What other people's pip packages add: plug-ins, controllers, planners … by entry points.

A package names its parts in its ``pyproject.toml``::

    [project.entry-points."gazelle.plugins"]
    wind_gust = "my_package.wind_gust:PLUGIN"

Nothing of it is imported before somebody asks for what Gazelle itself does not have, and a part
that cannot be loaded is a sentence for whoever asked, never the end of the others.
"""

from __future__ import annotations

from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = [
    "Extension",
    "ExtensionError",
    "ExtensionGroup",
    "Extensions",
    "entry_point_text",
    "entry_points_of",
    "find_entry_point",
    "folder_of",
    "load_extension",
    "load_extensions",
]

_T = TypeVar("_T")


class ExtensionGroup(StrEnum):
    """The groups of entry points that are looked at, without the ``gazelle.`` before them."""

    BAG_STORAGE = "bag_storage"
    CONTROLLERS = "controllers"
    DISPLAYS = "displays"
    NODES = "nodes"
    PANELS = "panels"
    PIPELINES = "planning_pipelines"
    PLANNERS = "planners"
    PLUGINS = "plugins"


class ExtensionError(GazelleError):
    """A part of another package cannot be had; says which, and why."""


class Extension(NamedTuple, Generic[_T]):
    """A part that was loaded.

    Attributes:
        name: of its entry point.
        origin: the entry point and the package in words.
        part: what it names.
    """

    name: str
    origin: str
    part: _T


class Extensions(NamedTuple, Generic[_T]):
    """What a group brings.

    Attributes:
        parts: what was loaded, in the order of the entry points' names.
        problems: one sentence for each that was not.
    """

    parts: tuple[Extension[_T], ...]
    problems: tuple[str, ...]


def entry_points_of(group: ExtensionGroup) -> tuple[EntryPoint, ...]:
    """Return the entry points of a group by name; nothing of them is imported."""
    # Takes longer to import than most commands take to start.
    from importlib.metadata import entry_points

    found = entry_points(group=f"gazelle.{group.value}")
    return tuple(sorted(found, key=lambda point: (point.name, point.value)))


def find_entry_point(group: ExtensionGroup, name: str) -> EntryPoint | None:
    """Return the entry point of a name in a group, None when no package has one."""
    return next((point for point in entry_points_of(group) if point.name == name), None)


def folder_of(point: EntryPoint) -> Path:
    """Return the folder that the package of an entry point is installed in."""
    distribution = point.dist
    return Path(str(distribution.locate_file(""))) if distribution is not None else Path()


def entry_point_text(point: EntryPoint) -> str:
    """Return an entry point in words: its line, the package with its version, the group."""
    distribution: Any = point.dist
    package = f"{distribution.name} {distribution.version}" if distribution else "no known package"
    return f"entry point '{point.name} = {point.value}' of {package} ({point.group})"


def load_extension(point: EntryPoint, kind: type[_T]) -> _T:
    """Import what an entry point names.

    Args:
        point: the entry point.
        kind: what the part has to be an instance of.

    Raises:
        ExtensionError: it cannot be imported, or is something else.
    """
    try:
        part = point.load()
    except Exception as error:
        text = f"{entry_point_text(point)} cannot be loaded: {type(error).__name__}: {error}"
        raise ExtensionError(text) from error
    if not isinstance(part, kind):
        what = f"a {type(part).__name__}, not a {kind.__module__}.{kind.__qualname__}"
        raise ExtensionError(f"{entry_point_text(point)} is {what}")
    return part


@cache
def load_extensions(group: ExtensionGroup, kind: type[_T]) -> Extensions[_T]:
    """Import the parts of a group, once in a process.

    Args:
        group: which.
        kind: what each has to be an instance of.
    """
    parts: list[Extension[_T]] = []
    problems: list[str] = []
    for point in entry_points_of(group):
        try:
            parts.append(
                Extension(point.name, entry_point_text(point), load_extension(point, kind))
            )
        except ExtensionError as error:
            problems.append(str(error))
    return Extensions(tuple(parts), tuple(problems))
