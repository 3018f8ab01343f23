"""Threads that do what must not be done in the event loop or in a transport's thread."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from contextlib import suppress
from queue import SimpleQueue
from typing import Any, TypeVar

__all__ = ["Workers", "in_thread"]

_T = TypeVar("_T")


class Workers:
    """A few threads that make frames, one job after the other.

    They are daemons: a job that hangs in a graph that has gone does not keep the process.
    """

    def __init__(self, count: int) -> None:
        """Start the threads."""
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._count = count
        for number in range(count):
            threading.Thread(target=self._run, name=f"studio {number}", daemon=True).start()

    def submit(self, job: Callable[[], None]) -> None:
        """Do a job soon; it must not raise."""
        self._jobs.put(job)

    def close(self) -> None:
        """End the threads behind the jobs that wait."""
        for _ in range(self._count):
            self._jobs.put(None)

    def _run(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()


async def in_thread(function: Callable[..., _T], *arguments: Any) -> _T:
    """Run a function that may take long in a thread of its own and return what it returns."""
    loop = asyncio.get_running_loop()
    future: asyncio.Future[_T] = loop.create_future()

    def settle(value: Any, error: BaseException | None) -> None:
        if future.cancelled():
            return
        if error is None:
            future.set_result(value)
        else:
            future.set_exception(error)

    def run() -> None:
        value, error = None, None
        try:
            value = function(*arguments)
        except Exception as raised:  # noqa: BLE001 - it is raised again where it is awaited
            error = raised
        # The server may have closed meanwhile; then nobody waits any more.
        with suppress(RuntimeError):
            loop.call_soon_threadsafe(settle, value, error)

    threading.Thread(target=run, daemon=True).start()
    return await future
