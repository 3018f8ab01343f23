"""Waiting calls of a process, so that it does not end in the midst of one."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["CallsInFlight"]


class CallsInFlight:
    """Counts threads that wait inside the transport.

    A thread that is still there when Python ends is ended by force, and the transport's frames
    cannot be: the process would abort.
    """

    def __init__(self) -> None:
        self._count = 0
        self._changed = threading.Condition()

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Mark the calling thread as one that waits."""
        with self._changed:
            self._count += 1
        try:
            yield
        finally:
            with self._changed:
                self._count -= 1
                self._changed.notify_all()

    def wait_until_none(self, timeout_s: float) -> bool:
        """Wait until no thread waits any more; False when time is up first."""
        with self._changed:
            return self._changed.wait_for(lambda: self._count == 0, timeout_s)
