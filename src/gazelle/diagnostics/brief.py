"""What is said when something starts: settings without effect in one line, the rest whole."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from gazelle.diagnostics.catalogue import entry_for
from gazelle.diagnostics.diagnostic import Diagnostic, Severity

__all__ = ["Brief", "brief"]


class Brief(NamedTuple):
    """Findings as they are said at a start.

    Attributes:
        shown: those that are said.
        kept: those that are for a list elsewhere: what one of the shown sums up, and what nobody
            has to do anything about.
    """

    shown: tuple[Diagnostic, ...]
    kept: tuple[Diagnostic, ...]


def brief(findings: Iterable[Diagnostic], kept: str = "") -> Brief:
    """Sum up the findings about settings that are known and have no effect here.

    One of them is said as it is, without its general remedy; of several the first is said, with
    their number. What works and asks for nothing is not said. Warnings and errors stay whole, and
    so does everything else.

    Args:
        findings: in the order they were made.
        kept: where all of them can be read, such as a file.
    """
    items = tuple(findings)
    quiet = tuple(item for item in items if _is_quiet(item))
    items = tuple(item for item in items if not _is_quiet(item))
    idle = [item for item in items if _is_idle(item)]
    if not idle:
        return Brief(items, quiet)
    first, summed = idle[0], tuple(idle) if len(idle) > 1 else ()
    if not summed:
        summary = replace(first, fix=_own_fix(first))
    else:
        where = f"; all of them: {kept}" if kept else ""
        line = first.message.partition("\n")[0]
        text = f"{len(idle)} settings are known and have no effect here{where}; the first: {line}"
        summary = replace(first, message=text, fix="", phrase="")
    shown = [summary if item is first else item for item in items
             if item is first or not _is_idle(item)]  # fmt: skip
    return Brief(tuple(shown), (*summed, *quiet))


def _is_quiet(item: Diagnostic) -> bool:
    return item.severity is Severity.INFO and entry_for(item.code).quiet


def _is_idle(item: Diagnostic) -> bool:
    return item.severity is Severity.INFO and entry_for(item.code).idle


def _own_fix(item: Diagnostic) -> str:
    return "" if item.fix == entry_for(item.code).fix else item.fix
