"""Parts that are made when somebody asks for them first: until then they cost a graph nothing."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import ExitStack, closing
from typing import Generic, Protocol, TypeVar

__all__ = ["Closable", "Lazy", "closed_with"]


class Closable(Protocol):
    """What has an end."""

    def close(self) -> None:
        """End it."""


_T = TypeVar("_T")
_C = TypeVar("_C", bound=Closable)


class Lazy(Generic[_T]):
    """A part that is made at the first call and returned by every one; from any thread."""

    def __init__(self, make: Callable[[], _T]) -> None:
        """Make nothing yet."""
        self._make = make
        self._lock = threading.Lock()
        self._made: list[_T] = []

    def __call__(self) -> _T:
        """Return the part."""
        with self._lock:
            if not self._made:
                self._made.append(self._make())
            return self._made[0]


def closed_with(ending: ExitStack, part: _C) -> _C:
    """Return a part that is closed where others end."""
    return ending.enter_context(closing(part))
