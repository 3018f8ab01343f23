"""Queues between whoever sends messages and the callbacks that take them."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any

from gazelle.ending import called_by_library

__all__ = ["Mailbox"]

_STOP: Any = object()


class Mailbox:
    """A bounded queue with a thread of its own that handles one item after the other.

    As in ROS 1 a full queue drops its oldest item, and the callbacks of one subscription never
    run at the same time while those of different subscriptions do. The thread starts with the
    first item.
    """

    def __init__(self, handle: Callable[[Any], None], *, size: int, name: str) -> None:
        """Start empty.

        Args:
            handle: called with each item; must not raise.
            size: most items that wait, 0 for no limit.
            name: the thread's name.
        """
        self._handle = handle
        self._size = size
        self._name = name
        self._items: SimpleQueue[Any] = SimpleQueue()
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()
        self._closed = False
        self.dropped = 0

    @called_by_library
    def put(self, item: Any) -> None:
        """Add an item, from any thread; never waits."""
        if self._closed:
            return
        if self._thread is None:
            self._start()
        if self._size and self._items.qsize() >= self._size:
            # The thread may take the last item in between: then nothing needs to go.
            with suppress(Empty):
                self._items.get_nowait()
                self.dropped += 1
        self._items.put(item)

    def close(self, timeout_s: float = 0.0) -> None:
        """Handle nothing more; wait for the item at work if there is time for it."""
        with self._lock:
            self._closed = True
            thread = self._thread
        self._items.put(_STOP)
        if thread is not None and timeout_s and thread is not threading.current_thread():
            thread.join(timeout_s)

    def _start(self) -> None:
        with self._lock:
            if self._thread is None and not self._closed:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while (item := self._items.get()) is not _STOP and not self._closed:
            self._handle(item)
