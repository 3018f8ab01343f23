"""Futures and tasks (rclpy.task); coroutines can await them."""

from __future__ import annotations

import inspect
import sys
import threading
import warnings
from collections.abc import Callable, Coroutine, Generator
from typing import Any, Protocol

__all__ = ["Future", "Task"]


class _Executor(Protocol):
    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Any: ...


# Per thread: the task of an executor that is just running.
_here = threading.local()


class Future:
    """A result that comes later; callbacks of an executor's futures run in the executor."""

    def __init__(self, *, executor: _Executor | None = None) -> None:
        self._done = False
        self._cancelled = False
        self._result: Any = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Any] = []
        self._lock = threading.Lock()
        self._executor = executor

    def __del__(self) -> None:
        if self._exception is not None and not self._exception_fetched:
            sys.stderr.write(f"The following exception was never retrieved: {self._exception}\n")

    def __await__(self) -> Generator[Future | None, None, Any]:
        while not self._done and not self._cancelled:
            # asyncio's tasks take nothing of ours; they come round again, as with rclpy.
            yield self if getattr(_here, "task", None) else None
        return self.result()

    def cancel(self) -> None:
        """Give it up; without effect when it is done."""
        with self._lock:
            if self._done:
                return
            self._cancelled = True
        self._tell()

    def cancelled(self) -> bool:
        """Tell whether it was given up."""
        return self._cancelled

    def done(self) -> bool:
        """Tell whether there is a result or an exception."""
        return self._done

    def result(self) -> Any:
        """Return the result, None before it has come; raise the exception if there is one."""
        if self._exception is not None:
            raise self.exception() or self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """Return the exception, None when there is none."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: Any) -> None:
        """Set the result."""
        with self._lock:
            self._result = result
            self._done = True
            self._cancelled = False
        self._tell()

    def set_exception(self, exception: BaseException) -> None:
        """Set an exception in place of a result."""
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._done = True
            self._cancelled = False
        self._tell()

    def add_done_callback(self, callback: Callable[[Any], Any]) -> None:
        """Call `callback(future)` when it is done, at once when it is already."""
        with self._lock:
            if not self._done and not self._cancelled:
                self._callbacks.append(callback)
                return
        self._run(callback)

    def remove_done_callback(self, callback: Callable[[Any], Any]) -> bool:
        """Call a callback no more; tell whether it was there."""
        with self._lock:
            if callback not in self._callbacks:
                return False
            self._callbacks.remove(callback)
            return True

    def _tell(self) -> None:
        with self._lock:
            callbacks, self._callbacks = self._callbacks, []
        for callback in callbacks:
            self._run(callback)

    def _run(self, callback: Any) -> None:
        if isinstance(callback, _InlineCallback):
            callback.callback(self)
            return
        if self._executor is not None:
            self._executor.create_task(callback, self)
            return
        try:
            callback(self)
        except Exception as error:  # noqa: BLE001 - as in rclpy one callback stops no other
            warnings.warn(f"Unhandled exception in done callback: {error}", stacklevel=2)

    def wake_with(self, wake: Callable[[Any], Any]) -> None:
        """Call `wake` when it is done, in the very thread that sets it."""
        with self._lock:
            if not self._done and not self._cancelled:
                self._callbacks.insert(0, _InlineCallback(wake))
                return
        wake(self)


class _InlineCallback:
    """A done callback that goes past the executor."""

    def __init__(self, callback: Callable[[Any], Any]) -> None:
        self.callback = callback


class Task(Future):
    """A function or coroutine that an executor runs, in steps where it awaits."""

    def __init__(
        self,
        handler: Callable[..., Any] | Coroutine[Any, Any, Any],
        args: tuple[Any, ...] = (),
        kwargs: dict[str, Any] | None = None,
        executor: _Executor | None = None,
    ) -> None:
        super().__init__(executor=executor)
        if inspect.iscoroutinefunction(handler):
            handler = handler(*args, **(kwargs or {}))
            args, kwargs = (), None
        self._handler: Any = handler
        self._args, self._kwargs = args, kwargs or {}

    def step(self) -> Future | None:
        """Run until the end or the next `await`; return what is awaited."""
        if self._done or self._cancelled:
            return None
        try:
            if not inspect.iscoroutine(self._handler):
                value = self._handler(*self._args, **self._kwargs)
                if not inspect.iscoroutine(value):
                    self.set_result(value)
                    return None
                # A callable that hands a coroutine back, such as a bound partial.
                self._handler = value
            awaited = self._advance()
        except StopIteration as end:
            self.set_result(end.value)
            return None
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            self.set_exception(error)
            return None
        if not isinstance(awaited, Future):
            # As rclpy: `await asyncio.sleep(0)` and its like just come round again.
            awaited = Future()
            awaited.set_result(None)
        return awaited

    def _advance(self) -> Any:
        outer, _here.task = getattr(_here, "task", None), self
        try:
            return self._handler.send(None)
        finally:
            _here.task = outer
