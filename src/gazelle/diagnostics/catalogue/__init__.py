"""The catalogue of diagnostic codes: one module per layer, one entry per code.

A code is ``<area>.<what-is-wrong>``. It never changes its meaning; `docs/diagnostics.md` is
generated from the entries and every code has a test that provokes it.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["Entry", "all_entries", "entry_for"]


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
