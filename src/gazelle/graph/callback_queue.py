"""Queues between whoever sends messages and the callbacks that take them."""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.graph.console import Level, LogRecord, print_record
from gazelle.graph.glibc_malloc import return_large_blocks
from gazelle.process_lifetime import called_by_library

__all__ = ["Bound", "CallbackQueue"]

_STOP: Any = object()


class Bound(NamedTuple):
    """How much may wait in a mailbox without a limit of items.

    Attributes:
        bytes: most bytes.
        weigh: tells how many an item has.
        pack: gives an item the form in which it waits.
        reached: called the first time when the oldest are dropped for it.
    """

    bytes: int
    weigh: Callable[[Any], int]
    pack: Callable[[Any], Any]
    reached: Callable[[], None]


class CallbackQueue:
    """A bounded queue with a thread of its own that handles one item after the other.

    As in ROS 1 a full queue drops its oldest item, and the callbacks of one subscription never
    run at the same time while those of different subscriptions do. The thread starts with the
    first item.
    """

    def __init__(
        self,
        handle: Callable[[Any], None],
        *,
        size: int,
        name: str,
        bound: Bound | None = None,
    ) -> None:
        """Start empty.

        Args:
            handle: called with each item; what it raises is told, once a kind, and the next
                item is handled.
            size: most items that wait, 0 for no limit.
            name: the thread's name.
            bound: of what waits where `size` is no limit; None for none.
        """
        self._bound = None if size else bound
        self._handle = handle
        self._size = size
        self._name = name
        self._items: SimpleQueue[Any] = SimpleQueue()
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()
        self._closed = False
        self._told: set[type[Exception]] = set()
        self.dropped = 0

    @called_by_library
    def put(self, item: Any) -> None:
        """Add an item, from any thread; never waits."""
        if self._closed:
            return
        if self._thread is None:
            self._start()
        if self._size and self._items.qsize() >= self._size:
            self._drop()
        elif self._bound is not None and self._items.qsize():
            item = self._bound.pack(item)
            self._make_room(self._bound, item)
        self._items.put(item)

    def close(self, timeout_s: float = 0.0) -> None:
        """Handle nothing more, let go of what waits, and give the item at work some time."""
        with self._lock:
            self._closed = True
            thread = self._thread
        with suppress(Empty):
            while True:
                self._items.get_nowait()
        self._items.put(_STOP)
        if thread is not None and timeout_s and thread is not threading.current_thread():
            thread.join(timeout_s)

    def _drop(self) -> None:
        # The thread may take the last item in between: then nothing needs to go.
        with suppress(Empty):
            self._items.get_nowait()
            self.dropped += 1

    def _make_room(self, bound: Bound, item: Any) -> None:
        """Let no more wait than if all were of this size: a lock would cost ten times that."""
        most = max(1, bound.bytes // max(1, bound.weigh(item)))
        if self._items.qsize() < most:
            return
        is_first = not self.dropped
        while self._items.qsize() >= most:
            self._drop()
        if is_first:
            return_large_blocks()
            bound.reached()

    def _start(self) -> None:
        with self._lock:
            if self._thread is None and not self._closed:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while (item := self._items.get()) is not _STOP and not self._closed:
            try:
                self._handle(item)
            except Exception as error:  # noqa: BLE001 - the next item may be a good one
                self._tell(error)

    def _tell(self, error: Exception) -> None:
        """Say what one item led to; the same kind of thing once."""
        if type(error) in self._told:
            return
        self._told.add(type(error))
        known = isinstance(error, GazelleError)
        text = str(error) if known else traceback.format_exc().rstrip()
        text = f"{self._name}: something that came is left out: {text}"
        print_record(LogRecord(Level.ERROR, text, node="", wall_ns=time.time_ns()))
