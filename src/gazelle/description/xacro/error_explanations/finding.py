"""An explained failure, and words that explanations share."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import NamedTuple

from gazelle.description.xacro.rerun_patches import UNKNOWN
from gazelle.diagnostics import SourceSpan

__all__ = [
    "Finding",
    "include_line",
    "is_below",
    "known_keys",
    "listed",
    "one_line",
    "short_place",
]

_MAX = 12


class Finding(NamedTuple):
    """A failure in words.

    Attributes:
        code: of the catalogue.
        message: what is wrong.
        span: where.
        fix: what to do, the catalogue's remedy when empty.
        subject: the name, macro, argument or file it is about.
    """

    code: str
    message: str
    span: SourceSpan
    fix: str = ""
    subject: str = ""


def one_line(text: str) -> str:
    """Return a text with all white space as single spaces."""
    return " ".join(text.split())


def listed(names: Iterable[str], nothing: str = "none") -> str:
    """Return names with commas; a long list ends with how many more there are."""
    found = list(dict.fromkeys(names))
    more = f" and {len(found) - _MAX} more" if len(found) > _MAX else ""
    return ", ".join(found[:_MAX]) + more if found else nothing


def short_place(span: SourceSpan) -> str:
    """Return ``file:line`` with the file's name alone."""
    return f"{os.path.basename(span.file)}:{span.line}"  # noqa: PTH119


def is_below(span: SourceSpan, other: SourceSpan) -> bool:
    """Tell whether a place comes after another one of the same file."""
    return span.file == other.file and (span.line, span.column) > (other.line, other.column)


def include_line(file: str, reader: str) -> str:
    """Return the element by which one file includes another."""
    folder = os.path.dirname(os.path.abspath(reader))  # noqa: PTH100, PTH120
    return f'<xacro:include filename="{os.path.relpath(file, folder)}"/>'


def known_keys(table: object) -> tuple[str, ...]:
    """Return the names in one of the library's tables and those around it, nearest first."""
    names: list[str] = []
    while isinstance(table, dict):
        names += [str(name) for name, value in dict.items(table) if value is not UNKNOWN]
        table = getattr(table, "parent", None)
    return tuple(dict.fromkeys(names))
