"""Headers of all messages that Gazelle knows, generated once for a version into the cache."""

from __future__ import annotations

import functools
from pathlib import Path

from gazelle.cpp.building.cache import (
    cache_top,
    digest_of_text,
    make_whole,
    only_one,
    stat_signature,
    touch,
)
from gazelle.cpp.runtime_libraries import HERE

__all__ = ["known_messages"]


@functools.cache
def known_messages(generation: int) -> Path:
    """Return the folder with the headers of the messages that Gazelle knows.

    Args:
        generation: 1 or 2, of ROS.
    """
    made_of = stat_signature((HERE / "interfaces", HERE.parent / "interfaces"))
    top = cache_top() / "messages"
    folder = top / f"ros{generation}-{digest_of_text(made_of)}"
    if not folder.is_dir():
        with only_one(top / f"ros{generation}.lock", "generating message headers"):
            if not folder.is_dir():
                from gazelle.cpp import interfaces

                with make_whole(folder) as made:
                    interfaces.known_messages(generation, made)
    touch(folder)
    return folder
