"""Turns: threads that began in an order do a part of their work in that order."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from typing import Any, Self

__all__ = ["InTurn", "Turn", "Turns"]


class Turn:
    """One thread's turn; a ``with`` block waits for it and ends it."""

    def __init__(self, before: Turn | None, on_end: Callable[[Turn], None]) -> None:
        """Line up; use `Turns.take`."""
        self._before = before
        self._on_end = on_end
        self._ended = threading.Event()

    def wait(self) -> None:
        """Wait until every turn that was taken before has ended."""
        before = self._before
        while before is not None:
            before._ended.wait()
            # One that ended without having waited itself leaves that to those behind it.
            before = before._before
        self._before = None

    def end(self) -> None:
        """Let the next one begin; calling it twice does nothing."""
        if not self._ended.is_set():
            self._ended.set()
            if self._before is None:
                self._on_end(self)

    def __enter__(self) -> Self:
        self.wait()
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.end()


class Turns:
    """Gives turns; those of different keys know nothing of each other."""

    def __init__(self) -> None:
        self._last: dict[Hashable, Turn] = {}
        self._lock = threading.Lock()

    def take(self, key: Hashable = None) -> Turn:
        """Return a turn behind all that were taken for this key before."""
        with self._lock:
            turn = Turn(self._last.get(key), lambda ended: self._forget(key, ended))
            self._last[key] = turn
        return turn

    def _forget(self, key: Hashable, turn: Turn) -> None:
        with self._lock:
            if self._last.get(key) is turn:
                del self._last[key]


class InTurn:
    """A service's handler in two parts.

    The first is done for the requests of one client in the order in which they were sent, one
    after the other; it must not wait for anything. The second gives the response, beside the
    next requests. Called like any other handler, it does both.
    """

    def __init__(self, begin: Callable[..., Callable[[], Any]]) -> None:
        """Wrap the first part, which returns the second.

        Args:
            begin: takes what a handler takes.
        """
        self.begin = begin

    def __call__(self, *words: Any) -> Any:
        """Do both parts and return the response."""
        return self.begin(*words)()
