"""What keeps somebody waiting, or costs them time again and again, said once in a process.

Whoever runs a node lets it be said in the node's log; elsewhere it goes to the standard error.
"""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Callable, Iterator
from contextvars import ContextVar

__all__ = ["Say", "announce", "announce_by", "announced_by"]

Say = Callable[[str], object]

_here: ContextVar[Say | None] = ContextVar("announcements", default=None)
_process: list[Say] = []
_told: set[str] = set()
_lock = threading.Lock()


def announce(text: str, *, key: str = "") -> None:
    """Say a text, unless it, or another of the same key, has been said before."""
    with _lock:
        if (key or text) in _told:
            return
        _told.add(key or text)
    say = _here.get() or (_process[-1] if _process else _print)
    # Nobody's work ends since nobody could be told of it.
    with contextlib.suppress(Exception):
        say(text)


def announce_by(say: Say) -> None:
    """Have this process say it by `say` from now on."""
    _process[:] = [say]


@contextlib.contextmanager
def announced_by(say: Say) -> Iterator[None]:
    """Have what this thread does within a ``with`` block said by `say`."""
    token = _here.set(say)
    try:
        yield
    finally:
        _here.reset(token)


def _print(text: str) -> None:
    if sys.stderr is not None:
        sys.stderr.write(f"gazelle: {text}\n")
        sys.stderr.flush()
