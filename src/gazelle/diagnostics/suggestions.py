"""The nearest existing names to a mistyped one."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import SequenceMatcher, get_close_matches
from functools import lru_cache

__all__ = ["did_you_mean", "likeness", "nearest_names"]


def nearest_names(name: str, existing: Iterable[str], *, count: int = 3) -> tuple[str, ...]:
    """Return the names most like `name`, best first; upper and lower case count as equal."""
    return _nearest(name, tuple(existing), count)


@lru_cache(maxsize=1024)
def _nearest(name: str, existing: tuple[str, ...], count: int) -> tuple[str, ...]:
    """Remember the answers: damaged files repeat the same unknown word thousands of times."""
    by_folded: dict[str, str] = {}
    for item in existing:
        by_folded.setdefault(item.casefold(), item)
    matches = get_close_matches(name.casefold(), by_folded, n=count, cutoff=0.6)
    return tuple(by_folded[item] for item in matches)


def did_you_mean(name: str, existing: Iterable[str]) -> str:
    """Return ``did you mean 'a' or 'b'?``, or an empty string when nothing is near."""
    found = nearest_names(name, existing)
    return "did you mean " + " or ".join(f"'{item}'" for item in found) + "?" if found else ""


def likeness(one: str, other: str) -> float:
    """Return how alike two names are, 0 to 1, as `difflib` counts it."""
    return SequenceMatcher(None, one, other).ratio()
