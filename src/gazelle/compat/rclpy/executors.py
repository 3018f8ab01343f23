"""Executors run the callbacks of nodes (rclpy.executors), and what they have to run."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future as _PoolFuture
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Protocol

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.context import Context, get_default_context
from gazelle.compat.rclpy.exceptions import (
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from gazelle.compat.rclpy.task import Future, Task

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "Executor",
    "ExternalShutdownException",
    "MultiThreadedExecutor",
    "Once",
    "ShutdownException",
    "SingleThreadedExecutor",
    "TimeoutException",
    "Work",
]


class Work(Protocol):
    """A subscription, timer, service … that has something to do."""

    callback_group: CallbackGroup

    def take(self) -> Callable[[], Any] | None:
        """Return the next thing to do, None when it is done already."""
        ...


class Once:
    """One call."""

    def __init__(self, callback_group: CallbackGroup, callback: Callable[[], Any]) -> None:
        self.callback_group = callback_group
        self._callback: Callable[[], Any] | None = callback

    def take(self) -> Callable[[], Any] | None:
        """Return the call, the first time."""
        callback, self._callback = self._callback, None
        return callback


class Executor:
    """Base of executors: finds callbacks that are ready and runs them one after the other."""

    def __init__(self, *, context: Context | None = None) -> None:
        self._context = context or get_default_context()
        self._nodes: list[Node] = []
        self._tasks: deque[tuple[Task, Work | None]] = deque()
        self._changed = threading.Condition()
        self._is_shutdown = False
        # Callbacks that have been handed out and have not returned; those of one thread.
        self._running_count = 0
        self._own = threading.local()
        self._context.add_waker(self.wake)

    def __enter__(self) -> Executor:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.shutdown()

    @property
    def context(self) -> Context:
        """The context that ends spinning."""
        return self._context

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:
        """Run a function or coroutine while spinning; return its future."""
        task = Task(callback, args, kwargs, executor=self)
        self._enqueue(task, None)
        return task

    def add_node(self, node: Node) -> bool:
        """Run this node's callbacks too; False when that is so already."""
        with self._changed:
            if node in self._nodes:
                return False
            self._nodes.append(node)
        node.executor = self
        self.wake()
        return True

    def remove_node(self, node: Node) -> None:
        """Run this node's callbacks no more."""
        with self._changed:
            self._nodes = [one for one in self._nodes if one is not node]

    def get_nodes(self) -> list[Node]:
        """Return the nodes."""
        return list(self._nodes)

    def wake(self) -> None:
        """Look for work now."""
        with self._changed:
            self._changed.notify_all()

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """End spinning and wait for the callbacks that run in other threads.

        Args:
            timeout_sec: the longest wait, None or a negative one for any.

        Returns:
            Whether all of them have ended.
        """
        self._is_shutdown = True
        for node in self.get_nodes():
            self.remove_node(node)
        self.wake()
        own = self._own_count()
        limit_s = None if timeout_sec is None or timeout_sec < 0 else timeout_sec
        with self._changed:
            return self._changed.wait_for(lambda: self._running_count <= own, limit_s)

    def _own_count(self) -> int:
        """Return how many callbacks of this executor the calling thread is in."""
        return getattr(self._own, "count", 0)

    def spin(self) -> None:
        """Run callbacks until the shutdown.

        Raises:
            ExternalShutdownException: the context was shut down.
        """
        while not self._is_shutdown and self._context.ok():
            self._spin_once(None)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Run one callback, waiting for it as long as told; None waits for ever.

        Raises:
            ExternalShutdownException: the context was shut down.
        """
        self._spin_once(timeout_sec)

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Run callbacks until a future is done, or time is up."""
        future.wake_with(lambda _future: self.wake())
        deadline = None if timeout_sec is None or timeout_sec < 0 else _now() + timeout_sec
        while self._context.ok() and not self._is_shutdown and not _is_over(future):
            left_s = None if deadline is None else deadline - _now()
            if left_s is not None and left_s < 0:
                return
            self._spin_once(left_s, until=lambda: _is_over(future))

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | None = None
    ) -> None:
        """Run one callback, or none when the future is done first."""
        future.wake_with(lambda _future: self.wake())
        self._spin_once(timeout_sec, until=lambda: _is_over(future))

    def _spin_once(
        self, timeout_sec: float | None, until: Callable[[], bool] = lambda: False
    ) -> None:
        found = self._wait(timeout_sec, until)
        if found is not None:
            task = found[0]
            self._run_step(*found)
            if found[1] is not None and task.done():
                task.result()

    def _wait(
        self, timeout_sec: float | None, until: Callable[[], bool]
    ) -> tuple[Task, Work | None] | None:
        """Return the next thing to run, None when time is up or `until` holds."""
        deadline = None if timeout_sec is None or timeout_sec < 0 else _now() + timeout_sec
        with self._changed:
            while True:
                if self._is_shutdown or until():
                    return None
                if not self._context.ok():
                    raise self._spin_end()
                found = self._next()
                if found is not None:
                    self._running_count += 1
                    return found
                left_s = None if deadline is None else deadline - _now()
                if left_s is not None and left_s <= 0:
                    return None
                self._changed.wait(left_s)

    def _spin_end(self) -> BaseException:
        """Return what spinning ends with: Ctrl-C is Ctrl-C.

        Python's own interrupt may come where nobody hears it, in a finaliser for one.
        """
        in_main = threading.current_thread() is threading.main_thread()
        interrupted = in_main and self._context.interrupted
        return KeyboardInterrupt() if interrupted else ExternalShutdownException()

    def _next(self) -> tuple[Task, Work | None] | None:
        if self._tasks:
            return self._tasks.popleft()
        for index, node in enumerate(self._nodes):
            found = node.next_work()
            if found is not None:
                # The next time another node comes first.
                self._nodes = self._nodes[index + 1 :] + self._nodes[: index + 1]
                work, callback = found
                return Task(callback, executor=self), work
        return None

    def _run_step(self, task: Task, work: Work | None) -> None:
        """Run a task up to its end or its next `await`."""
        self._own.count = self._own_count() + 1
        try:
            awaited = task.step()
        finally:
            self._own.count -= 1
            with self._changed:
                self._running_count -= 1
                self._changed.notify_all()
        if awaited is not None:
            awaited.wake_with(lambda _future: self._enqueue(task, work))
        elif work is not None:
            work.callback_group.ending_execution(work)
            self.wake()

    def _enqueue(self, task: Task, work: Work | None) -> None:
        with self._changed:
            self._tasks.append((task, work))
            self._changed.notify_all()


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads, as their groups allow.

    Args:
        num_threads: as many as the machine has processors, two at least, when None.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        count = num_threads or max(2, os.cpu_count() or 2)
        self._pool = ThreadPoolExecutor(count, thread_name_prefix="executor")
        self._running: list[tuple[_PoolFuture[None], Task, Work | None]] = []

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """End spinning and wait for the callbacks that run, see `Executor.shutdown`."""
        all_over = super().shutdown(timeout_sec)
        self._pool.shutdown(wait=False)
        return all_over

    def _spin_once(
        self, timeout_sec: float | None, until: Callable[[], bool] = lambda: False
    ) -> None:
        try:
            found = self._wait(timeout_sec, until)
        except ExternalShutdownException:
            # As in rclpy, which raises it in the single-threaded one only.
            found = None
        if found is not None:
            pooled = self._pool.submit(self._run_step, *found)
            self._running.append((pooled, *found))
        over = [one for one in self._running if one[0].done()]
        self._running = [one for one in self._running if not one[0].done()]
        for pooled, task, work in over:
            pooled.result()
            if work is not None and task.done():
                task.result()


def _is_over(future: Future) -> bool:
    return future.done() or future.cancelled()


def _now() -> float:
    return time.monotonic()
