"""Requests that come twice, because the link was lost before their answer had come."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

__all__ = ["Answer", "Repeats"]

_KEPT_S = 60.0
_KEPT_BYTES = 16_000_000

Answer = tuple[bytes, str]
"""A response's bytes and, where there is none, why."""


@dataclass
class _Call:
    done: threading.Event = field(default_factory=threading.Event)
    answer: Answer = (b"", "")
    ended_s: float = 0.0


class Repeats:
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
