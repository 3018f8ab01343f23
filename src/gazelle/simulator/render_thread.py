"""Renders camera frames beside the loop; late frames are dropped and counted."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

__all__ = ["FrameWorker"]


class FrameWorker:
    """One thread that renders, for all cameras.

    Attributes:
        dropped: frames not rendered because the camera's last one was not ready, by camera.
    """

    def __init__(self, prepare: Callable[[], None] = lambda: None) -> None:
        """Start nothing yet.

        Args:
            prepare: done once, before the first frame that somebody wants; takes its time.
                Frames that are due meanwhile are left out without being counted.
        """
        self._prepare = prepare
        self._preparing: Future[None] | None = None
        self._pool: ThreadPoolExecutor | None = None
        self._running: dict[str, Future[None]] = {}
        self._lock = threading.Lock()
        self.dropped: dict[str, int] = {}

    def submit(self, camera: str, job: Callable[[], None]) -> bool:
        """Start a frame unless the camera's last one is unfinished; False when it is dropped.

        Raises:
            Exception: whatever the camera's previous job raised.
        """
        with self._lock:
            last = self._running.get(camera)
            if last is not None and not last.done():
                if self._preparing is not None and not self._preparing.done():
                    return True
                self.dropped[camera] = self.dropped.get(camera, 0) + 1
                return False
            if last is not None:
                last.result()
            if self._pool is None:
                self._pool = ThreadPoolExecutor(1, thread_name_prefix="gazelle-render")
                self._preparing = self._pool.submit(self._prepare_once)
            self._running[camera] = self._pool.submit(job)
            return True

    def do(self, job: Callable[[], None]) -> None:
        """Do a frame at once, in the calling thread."""
        self._prepare_once()
        job()

    def wait(self) -> None:
        """Wait until every frame that was started is done."""
        for future in tuple(self._running.values()):
            future.result()

    def close(self) -> None:
        """Finish the frame at work and end the thread."""
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)
            self._pool = None
        self._running.clear()

    def _prepare_once(self) -> None:
        prepare, self._prepare = self._prepare, lambda: None
        prepare()
