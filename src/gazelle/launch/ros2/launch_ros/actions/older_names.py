"""Arguments that were called otherwise up to Foxy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.launch.ros2.deprecation import warn_once

__all__ = ["newer_names"]


def newer_names(
    owner: str, given: dict[str, Any], kwargs: dict[str, Any], old_names: Mapping[str, str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return arguments by their names of today, and those that are left.

    Args:
        owner: the class, for messages.
        given: by the names of today, None where nothing is given.
        kwargs: all others.
        old_names: old names and those of today.

    Raises:
        TypeError: an argument is given by both names.
    """
    found, rest = dict(given), dict(kwargs)
    for old, new in old_names.items():
        if old not in rest:
            continue
        if found.get(new) is not None:
            raise TypeError(f"{owner}: both '{old}' and '{new}' are given; leave out '{old}'")
        found[new] = rest.pop(old)
        warn_once(
            f"The parameter '{old}' of {owner} is deprecated, use '{new}' (Foxy was the last to "
            "have it)",
            FutureWarning,
            stacklevel=3,
        )
    return found, rest
