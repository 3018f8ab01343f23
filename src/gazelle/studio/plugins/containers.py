"""How widgets stand: beside each other or below each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from gazelle.studio.plugins.widgets import Widget

__all__ = ["Column", "Part", "Row", "all_widgets"]


@dataclass(frozen=True, slots=True, init=False)
class Row:
    """Widgets beside each other.

    Attributes:
        children: widgets, rows and columns.
        title: shown above them.
    """

    children: tuple[Part, ...]
    title: str

    def __init__(self, *children: Part, title: str = "") -> None:
        object.__setattr__(self, "children", children)
        object.__setattr__(self, "title", title)


@dataclass(frozen=True, slots=True, init=False)
class Column:
    """Widgets below each other; with a title, a group.

    Attributes:
        children: widgets, rows and columns.
        title: shown above them.
    """

    children: tuple[Part, ...]
    title: str

    def __init__(self, *children: Part, title: str = "") -> None:
        object.__setattr__(self, "children", children)
        object.__setattr__(self, "title", title)


Part = Widget | Row | Column


def all_widgets(parts: Iterable[object]) -> Iterator[object]:
    """Yield everything inside rows and columns, in order; what is no widget too."""
    for part in parts:
        if isinstance(part, Row | Column):
            yield from all_widgets(part.children)
        else:
            yield part
