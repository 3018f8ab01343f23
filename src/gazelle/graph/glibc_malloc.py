"""What glibc's malloc does with memory that is free again: give it back, or keep it."""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from functools import cache
from typing import Any, NamedTuple

__all__ = ["HeapTrim", "keep_freed_memory", "return_large_blocks"]

_KEPT_BYTES = 256 << 20
_OWN_MAPPING_BYTES = 32 << 20
# M_TRIM_THRESHOLD and M_MMAP_THRESHOLD of glibc's malloc.h.
_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
_LARGE_BYTES = 64 << 10
# A trim takes 0.1 ms where there is little to give back, the bytes some 12 ms to come.
_TRIM_EVERY_BYTES = 32 << 20


def keep_freed_memory() -> bool:
    """Let the C library keep what frames have used; return whether it can be told so.

    Otherwise the megabytes of each cloud are given back to the system and fetched again, page by
    page, twenty times a second: a tenth of the server's time. Only glibc is told.
    """
    library = _glibc()
    if library is None:
        return False
    kept = library.mallopt(_TRIM_THRESHOLD, _KEPT_BYTES)
    return bool(kept and library.mallopt(_MMAP_THRESHOLD, _OWN_MAPPING_BYTES))


def return_large_blocks() -> None:
    """Let blocks of 64 KiB and more go back to the system when they are freed, where glibc is.

    It raises its limit with each such block that is freed, up to 32 MiB, and keeps those below it
    in heaps; where pictures come and go among small blocks these have more and more holes. A
    picture of 320 x 240 takes 0.4 ms longer to come and go then: only for who has many waiting.
    """
    library = _glibc()
    if library is not None:
        library.mallopt(_MMAP_THRESHOLD, _LARGE_BYTES)
        library.mallopt(_TRIM_THRESHOLD, _LARGE_BYTES)


class HeapTrim:
    """Gives back what is free in heaps each time that many bytes of large messages have come.

    Each thread of the transport has a heap, and of those in which pictures come and go none ever
    gets smaller by itself: with time there is a free place for a picture in all of them.
    """

    def __init__(self) -> None:
        """Begin to count."""
        self._taken = 0

    def took(self, size: int) -> None:
        """Take in that a message of so many bytes came; cheap for small ones."""
        if size < _LARGE_BYTES:
            return
        # Threads that count at the same time may lose some bytes: it is no matter when exactly.
        self._taken += size
        if self._taken >= _TRIM_EVERY_BYTES:
            self._taken = 0
            library = _glibc()
            if library is not None:
                library.malloc_trim(0)


class _Glibc(NamedTuple):
    mallopt: Any
    malloc_trim: Any


@cache
def _glibc() -> _Glibc | None:
    """Return what is asked of glibc here; None elsewhere and with other C libraries of Linux."""
    if not sys.platform.startswith("linux"):
        return None
    with suppress(AttributeError, OSError):
        library = ctypes.CDLL(None)
        library.malloc_trim.argtypes = [ctypes.c_size_t]
        return _Glibc(library.mallopt, library.malloc_trim)
    return None
