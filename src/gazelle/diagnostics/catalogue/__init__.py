"""The catalogue of diagnostic codes: one module per area, one entry per code.

A code is ``<area>.<what-is-wrong>``. It never changes its meaning; `docs/diagnostics.md` is
generated from the entries and every code has a test that provokes it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Literal

__all__ = ["Entry", "all_entries", "entry_for"]


@dataclass(frozen=True, slots=True)
class Entry:
    """One code of the catalogue.

    Attributes:
        code: ``<area>.<what-is-wrong>``, stable for ever.
        severity: default severity.
        title: one line for the docs' headline.
        why: why it matters and what Gazelle does about it.
        fix: the general remedy.
        phrase: the words ROS or Gazebo print in this case, empty when they are silent.
        idle: it says of a setting that it is known and has no effect here; at a start such findings
            are summed, see `gazelle.diagnostics.collection`.
        quiet: it says of something that it is done, or that nothing is to be done about it; at a
            start it goes to the log file alone.
    """

    code: str
    severity: Literal["info", "warning", "error"]
    title: str
    why: str
    fix: str
    phrase: str = ""
    idle: bool = False
    quiet: bool = False


@cache
def all_entries() -> dict[str, Entry]:
    """Return every entry by code, sorted by code.

    Raises:
        ValueError: two modules define the same code.
    """
    entries: dict[str, Entry] = {}
    for info in sorted(iter_modules(__path__), key=lambda item: item.name):
        module = import_module(f"{__name__}.{info.name}")
        for entry in getattr(module, "ENTRIES", ()):
            if entry.code in entries:
                raise ValueError(f"diagnostic code '{entry.code}' is defined twice")
            entries[entry.code] = entry
    return dict(sorted(entries.items()))


def entry_for(code: str) -> Entry:
    """Return the entry of a code.

    Raises:
        KeyError: there is no such code.
    """
    return all_entries()[code]
