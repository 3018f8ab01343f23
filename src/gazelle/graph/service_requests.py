"""How a service handles requests: those of one client in order where it matters, none twice."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any, Self

__all__ = ["Answer", "AnsweredRequests", "InTurn", "Turn", "Turns"]

_KEPT_S = 60.0
_KEPT_BYTES = 16_000_000

Answer = tuple[bytes, str]
"""A response's bytes and, where there is none, why."""


@dataclass
class _Call:
    done: threading.Event = field(default_factory=threading.Event)
    answer: Answer = (b"", "")
    ended_s: float = 0.0


class AnsweredRequests:
    """Answers of one service by call, so that no request is handled twice."""

    def __init__(self) -> None:
        self._calls: dict[tuple[bytes, int], _Call] = {}
        self._ended: dict[tuple[bytes, int], int] = {}
        self._size = 0
        self._lock = threading.Lock()

    def answer(
        self,
        client: bytes,
        sequence: int,
        handle: Callable[[], Answer],
        *,
        on_repeat: Callable[[], None] | None = None,
    ) -> Answer:
        """Return the answer to a request, handling it unless that is done or under way.

        Args:
            client: who asks.
            sequence: number of the client's request, 0 where it does not count them.
            handle: handles the request.
            on_repeat: called before waiting for the end of a request that is under way.
        """
        if sequence == 0:
            return handle()
        key = (client, sequence)
        with self._lock:
            known = self._calls.get(key)
            call = self._calls.setdefault(key, _Call()) if known is None else known
        if known is None:
            try:
                call.answer = handle()
            finally:
                # Whoever repeats it must not wait for ever, even if the handler ended its thread.
                self._note_end(key, call)
                call.done.set()
        elif on_repeat is not None:
            on_repeat()
        call.done.wait()
        return call.answer

    def _note_end(self, key: tuple[bytes, int], call: _Call) -> None:
        """Keep the answer for a while: nobody knows whether it arrives."""
        with self._lock:
            call.ended_s = time.monotonic()
            self._ended[key] = len(call.answer[0])
            self._size += self._ended[key]
            while self._is_enough(call.ended_s):
                oldest = next(iter(self._ended))
                self._size -= self._ended.pop(oldest)
                del self._calls[oldest]

    def _is_enough(self, now_s: float) -> bool:
        oldest = next(iter(self._ended), None)
        if oldest is None:
            return False
        return self._size > _KEPT_BYTES or now_s - self._calls[oldest].ended_s > _KEPT_S


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

    def __call__(self, *arguments: Any) -> Any:
        """Do both parts and return the response."""
        return self.begin(*arguments)()
