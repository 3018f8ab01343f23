"""launch_pytest.tools: waiting for what a process does, in the loop or in another thread."""

from __future__ import annotations

import asyncio
import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

from gazelle.launch.ros2.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "assert_output",
    "assert_output_sync",
    "assert_stderr",
    "assert_stderr_sync",
    "wait_for_exit",
    "wait_for_exit_sync",
    "wait_for_output",
    "wait_for_output_sync",
    "wait_for_start",
    "wait_for_start_sync",
    "wait_for_stderr",
    "wait_for_stderr_sync",
]

_Validate = Callable[[str], Any]
_POLL_S = 0.02


async def wait_for_output(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> bool:
    """Return whether standard output, which has to be cached, becomes valid in so many seconds."""
    return await _become(
        launch_context, process, _check(process.get_stdout, validate_output), timeout
    )


async def wait_for_stderr(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> bool:
    """Return whether standard error, which has to be cached, becomes valid in so many seconds."""
    return await _become(
        launch_context, process, _check(process.get_stderr, validate_output), timeout
    )


async def assert_output(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> None:
    """Wait until a function finds nothing wrong with standard output, or raise what it raises."""
    is_right = _raises_not(process.get_stdout, validate_output)
    if not await _become(launch_context, process, is_right, timeout):
        validate_output(process.get_stdout())


async def assert_stderr(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> None:
    """Wait until a function finds nothing wrong with standard error, or raise what it raises."""
    is_right = _raises_not(process.get_stderr, validate_output)
    if not await _become(launch_context, process, is_right, timeout):
        validate_output(process.get_stderr())


async def wait_for_start(
    launch_context: LaunchContext, process: Any, timeout: float | None = None
) -> bool:
    """Return whether a process has begun, or does so in so many seconds."""
    return await _become(launch_context, process, lambda: _has_begun(process), timeout)


async def wait_for_exit(
    launch_context: LaunchContext, process: Any, timeout: float | None = None
) -> bool:
    """Return whether a process has ended, or does so in so many seconds."""
    return await _become(launch_context, process, lambda: _has_ended(process), timeout)


def wait_for_output_sync(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> bool:
    """Do what `wait_for_output` does, in another thread than the launch's."""
    return _become_sync(
        launch_context, process, _check(process.get_stdout, validate_output), timeout
    )


def wait_for_stderr_sync(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> bool:
    """Do what `wait_for_stderr` does, in another thread than the launch's."""
    return _become_sync(
        launch_context, process, _check(process.get_stderr, validate_output), timeout
    )


def assert_output_sync(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> None:
    """Do what `assert_output` does, in another thread than the launch's."""
    is_right = _raises_not(process.get_stdout, validate_output)
    if not _become_sync(launch_context, process, is_right, timeout):
        validate_output(process.get_stdout())


def assert_stderr_sync(
    launch_context: LaunchContext, process: Any, validate_output: _Validate, timeout: Any = None
) -> None:
    """Do what `assert_stderr` does, in another thread than the launch's."""
    is_right = _raises_not(process.get_stderr, validate_output)
    if not _become_sync(launch_context, process, is_right, timeout):
        validate_output(process.get_stderr())


def wait_for_start_sync(
    launch_context: LaunchContext, process: Any, timeout: float | None = None
) -> bool:
    """Do what `wait_for_start` does, in another thread than the launch's."""
    return _become_sync(launch_context, process, lambda: _has_begun(process), timeout)


def wait_for_exit_sync(
    launch_context: LaunchContext, process: Any, timeout: float | None = None
) -> bool:
    """Do what `wait_for_exit` does, in another thread than the launch's."""
    return _become_sync(launch_context, process, lambda: _has_ended(process), timeout)


def _check(read: Callable[[], str], validate: _Validate) -> Callable[[], bool]:
    return lambda: bool(validate(read()))


def _raises_not(read: Callable[[], str], validate: _Validate) -> Callable[[], bool]:
    def is_right() -> bool:
        try:
            validate(read())
        except AssertionError:
            return False
        return True

    return is_right


def _has_begun(process: Any) -> bool:
    return "pid" in (process.process_details or {})


def _has_ended(process: Any) -> bool:
    return process.return_code is not None


@contextlib.contextmanager
def _told(context: LaunchContext, process: Any, report: Callable[[], object]) -> Iterator[None]:
    """Call a function whenever something happens to a process."""

    def on_event(*_event: Any) -> None:
        report()

    handlers = [
        OnProcessIO(target_action=process, on_stdout=on_event, on_stderr=on_event),
        OnProcessStart(target_action=process, on_start=on_event),
        OnProcessExit(target_action=process, on_exit=on_event),
    ]
    for handler in handlers:
        context.register_event_handler(handler, append=True)
    try:
        yield
    finally:
        for handler in handlers:
            context.unregister_event_handler(handler)


async def _become(
    context: LaunchContext, process: Any, holds: Callable[[], bool], timeout_s: float | None
) -> bool:
    happened = asyncio.Event()
    with _told(context, process, happened.set), contextlib.suppress(TimeoutError):
        async with asyncio.timeout(timeout_s):
            while not holds():
                await happened.wait()
                happened.clear()
    return holds()


def _become_sync(
    context: LaunchContext, process: Any, holds: Callable[[], bool], timeout_s: float | None
) -> bool:
    happened = threading.Event()
    deadline = None if timeout_s is None else time.monotonic() + timeout_s
    with _told(context, process, happened.set):
        while not holds():
            if deadline is not None and time.monotonic() >= deadline:
                break
            # What happens between the look and the wait is seen a moment later.
            happened.wait(_POLL_S)
            happened.clear()
    return holds()
