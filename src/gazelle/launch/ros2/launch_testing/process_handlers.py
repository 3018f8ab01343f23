"""What the processes of a launch wrote, and how they ended, for tests in another thread."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from gazelle.launch.ros2.events.process import ProcessExited
from gazelle.launch.ros2.launch_testing.asserts import assertInStream
from gazelle.launch.ros2.launch_testing.proc_lookup import (
    NoMatchingProcessException,
    resolveProcesses,
)

__all__ = ["ActiveIoHandler", "ActiveProcInfoHandler", "IoHandler", "ProcInfoHandler"]

_PATIENCE_S = 10
_LOOK_S = 0.2


class IoHandler:
    """The output of processes that have ended; iterating gives its events in order."""

    def __init__(self) -> None:
        self._events: list[Any] = []
        self._by_name: dict[str, list[Any]] = {}

    def track(self, process_name: str) -> None:
        """Know a process, whether it writes something or not."""
        self._by_name.setdefault(process_name, [])

    def append(self, process_io: Any) -> None:
        """Add an event of output."""
        self._events.append(process_io)
        self._by_name.setdefault(process_io.process_name, []).append(process_io)

    def __iter__(self) -> Iterator[Any]:
        return iter(self._events)

    def processes(self) -> list[Any]:
        """Return the actions of processes that wrote something."""
        return [events[0].action for events in self._by_name.values() if events]

    def process_names(self) -> list[str]:
        """Return the names of processes."""
        return list(self._by_name)

    def __getitem__(self, key: Any) -> list[Any]:
        """Return the events of a process, by its name or action."""
        return list(self._by_name[key if isinstance(key, str) else key.process_details["name"]])


class _Awaited:
    """Something that tests wait for in another thread.

    Attributes:
        heard_s: monotonic time when a test that waits was last told of something.
    """

    def __init__(self) -> None:
        self.heard_s = -math.inf
        self._condition = threading.Condition()
        self._waits = 0

    @contextmanager
    def _waiting(self) -> Iterator[threading.Condition]:
        with self._condition:
            self._waits += 1
            try:
                yield self._condition
            finally:
                self._waits -= 1

    def _notify(self) -> None:
        if self._waits:
            self.heard_s = time.monotonic()
        self._condition.notify_all()


class ActiveIoHandler(_Awaited):
    """The output of processes that still run."""

    def __init__(self) -> None:
        super().__init__()
        self._io_handler = IoHandler()

    @property
    def io_event(self) -> threading.Condition:
        """Is notified of everything that is written."""
        return self._condition

    def track(self, process_name: str) -> None:
        """Know a process, whether it writes something or not."""
        with self._condition:
            self._io_handler.track(process_name)
            self._notify()

    def append(self, process_io: Any) -> None:
        """Add an event of output."""
        with self._condition:
            self._io_handler.append(process_io)
            self._notify()

    def __iter__(self) -> Iterator[Any]:
        with self._condition:
            return iter(list(self._io_handler))

    def processes(self) -> list[Any]:
        """Return the actions of processes that wrote something."""
        with self._condition:
            return self._io_handler.processes()

    def process_names(self) -> list[str]:
        """Return the names of processes."""
        with self._condition:
            return self._io_handler.process_names()

    def __getitem__(self, key: Any) -> list[Any]:
        with self._condition:
            return self._io_handler[key]

    def assertWaitFor(self, *args: Any, **kwargs: Any) -> None:
        """Wait for a text, see `waitFor`, and fail when it does not come."""
        assert self.waitFor(*args, **kwargs), "Waiting for output timed out"

    def waitFor(
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Any = None,
        timeout: float = _PATIENCE_S,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> bool:
        """Return whether a text is written within so many seconds; see `assertInStream`.

        Raises:
            Exception: no such process wrote anything at all.
        """

        def is_there() -> bool:
            try:
                assertInStream(
                    self._io_handler,
                    expected_output,
                    process,
                    cmd_args,
                    output_filter=output_filter,
                    strict_proc_matching=strict_proc_matching,
                    strip_ansi_escape_sequences=strip_ansi_escape_sequences,
                    stream=stream,
                )
            except (NoMatchingProcessException, AssertionError):
                return False
            return True

        with self._waiting() as told:
            is_found = told.wait_for(is_there, timeout)
        if not is_found:
            resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=False)
        return is_found


class ProcInfoHandler:
    """How processes ended; iterating gives the last event of each."""

    def __init__(self) -> None:
        self._events: dict[Any, Any] = {}

    def append(self, process_info: Any) -> None:
        """Add a start or an end."""
        self._events[process_info.action] = process_info

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._events.values()))

    def processes(self) -> list[Any]:
        """Return the actions of processes that have been started."""
        return list(self._events)

    def process_names(self) -> list[str]:
        """Return their names."""
        return [action.process_details["name"] for action in self._events]

    def __getitem__(self, key: Any) -> Any:
        """Return the last event of a process, by its action or a part of its name."""
        if not isinstance(key, str):
            return self._events[key]
        for action, event in self._events.items():
            if key in action.process_details["name"]:
                return event
        raise KeyError(key)


class ActiveProcInfoHandler(_Awaited):
    """Starts and ends of processes while the launch runs."""

    def __init__(self) -> None:
        super().__init__()
        self._proc_info_handler = ProcInfoHandler()

    @property
    def proc_event(self) -> threading.Condition:
        """Is notified of every start and end."""
        return self._condition

    def append(self, process_info: Any) -> None:
        """Add a start or an end."""
        with self._condition:
            self._proc_info_handler.append(process_info)
            self._notify()

    def __iter__(self) -> Iterator[Any]:
        with self._condition:
            return iter(self._proc_info_handler)

    def processes(self) -> list[Any]:
        """Return the actions of processes that have been started."""
        with self._condition:
            return self._proc_info_handler.processes()

    def process_names(self) -> list[str]:
        """Return their names."""
        with self._condition:
            return self._proc_info_handler.process_names()

    def __getitem__(self, key: Any) -> Any:
        with self._condition:
            return self._proc_info_handler[key]

    def assertWaitForShutdown(
        self, process: Any, cmd_args: Any = None, *, timeout: float = _PATIENCE_S
    ) -> None:
        """Wait so many seconds for the end of a process, and fail when it does not come."""
        is_over = self._wait(
            lambda event: isinstance(event, ProcessExited), process, cmd_args, timeout
        )
        assert is_over, _reason(process, "finish")

    def assertWaitForStartup(
        self, process: Any, cmd_args: Any = None, *, timeout: float = _PATIENCE_S
    ) -> None:
        """Wait so many seconds for the start of a process, and fail when it does not come."""
        has_begun = self._wait(lambda _event: True, process, cmd_args, timeout)
        assert has_begun, _reason(process, "start")

    def _wait(self, is_it: Any, process: Any, cmd_args: Any, timeout: float) -> bool:
        def holds() -> bool:
            known = self._proc_info_handler
            try:
                (action,) = resolveProcesses(known, process=process, cmd_args=cmd_args)
            except NoMatchingProcessException:
                return False
            return bool(is_it(known[action]))

        end_s = time.monotonic() + timeout
        with self._waiting() as told:
            # That a node does not compile is not an event: it is looked at now and then.
            while not told.wait_for(holds, min(_LOOK_S, end_s - time.monotonic())):
                if _is_absent(process) or time.monotonic() >= end_s:
                    return False
        return True


def _is_absent(process: Any) -> bool:
    """Tell whether an action of a node found nothing to run, so that no wait for it helps."""
    return bool(getattr(process, "is_absent", False))


def _reason(process: Any, wanted: str) -> str:
    if _is_absent(process):
        return f"process '{process}' cannot {wanted}: there is no such program here"
    return f"Timed out waiting for process '{process}' to {wanted}"
