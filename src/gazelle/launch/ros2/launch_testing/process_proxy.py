"""launch_testing.tools.process: a process that a test starts and watches."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

from gazelle.launch.ros2.actions import ExecuteProcess
from gazelle.launch.ros2.events import IncludeLaunchDescription, matches_action
from gazelle.launch.ros2.events.process import ProcessExited, ProcessStarted, ShutdownProcess
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_testing.process_handlers import (
    ActiveIoHandler,
    ActiveProcInfoHandler,
)
from gazelle.launch.ros2.utilities import ensure_argument_type

__all__ = ["ProcessProxy", "launch_process"]


class _BoolWithText:
    """A bool that shows the output it was found by."""

    def __init__(self, result: bool, output: str | None) -> None:
        self._result = result
        self._output = output

    def __bool__(self) -> bool:
        return self._result

    def __repr__(self) -> str:
        return f"<BoolWithText({self._result}): {self._output!r}>"


class ProcessProxy:
    """One process of a launch, for a test in another thread.

    Attributes:
        target_process_action: its action.
    """

    def __init__(
        self,
        process_action: ExecuteProcess,
        proc_info: ActiveProcInfoHandler,
        proc_output: ActiveIoHandler,
        *,
        output_filter: Callable[[str], str] | None = None,
    ) -> None:
        ensure_argument_type(process_action, ExecuteProcess, "process_action")
        ensure_argument_type(proc_info, ActiveProcInfoHandler, "proc_info")
        ensure_argument_type(proc_output, ActiveIoHandler, "proc_output")
        self.target_process_action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._output_filter = output_filter

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Return whether it ends within so many seconds."""
        with self._proc_info.proc_event:
            return self._proc_info.proc_event.wait_for(lambda: self.terminated, timeout)

    def wait_for_output(
        self, condition: Callable[[str], Any] | None = None, timeout: float | None = None
    ) -> Any:
        """Return whether its output so far meets a condition within so many seconds."""
        seen: str | None = None

        def holds() -> bool:
            nonlocal seen
            if not self.running:
                return False
            seen = self.output
            return condition is None or bool(condition(seen))

        with self._proc_output.io_event:
            found = self._proc_output.io_event.wait_for(holds, timeout)
        return _BoolWithText(found, seen)

    @property
    def stdout(self) -> str:
        """What it wrote to standard output so far."""
        return self._text(lambda event: event.from_stdout)

    @property
    def stderr(self) -> str:
        """What it wrote to standard error so far."""
        return self._text(lambda event: event.from_stderr)

    @property
    def output(self) -> str:
        """What it wrote so far."""
        return self._text(lambda _event: True)

    def _text(self, is_wanted: Callable[[Any], bool]) -> str:
        events = self._proc_output[self.target_process_action]
        text = "".join(event.text.decode() for event in events if is_wanted(event))
        return text if self._output_filter is None else self._output_filter(text)

    @property
    def running(self) -> bool:
        """Whether it has begun and not ended."""
        return self._last_event_is(ProcessStarted)

    @property
    def terminated(self) -> bool:
        """Whether it has ended."""
        return self._last_event_is(ProcessExited)

    def _last_event_is(self, kind: type) -> bool:
        action = self.target_process_action
        known = action in self._proc_info.processes()
        return known and isinstance(self._proc_info[action], kind)

    @property
    def exit_code(self) -> int:
        """Its exit code once it has ended."""
        code: int = self._proc_info[self.target_process_action].returncode
        return code


@contextlib.contextmanager
def launch_process(
    launch_service: Any,
    process_action: ExecuteProcess,
    proc_info: ActiveProcInfoHandler,
    proc_output: ActiveIoHandler,
    **kwargs: Any,
) -> Iterator[ProcessProxy]:
    """Start a process in a launch that runs, and end it behind the block."""
    ensure_argument_type(process_action, ExecuteProcess, "process_action")
    description = LaunchDescription([process_action])
    launch_service.emit_event(event=IncludeLaunchDescription(description))
    proxy = ProcessProxy(process_action, proc_info, proc_output, **kwargs)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            matcher = matches_action(process_action)
            launch_service.emit_event(event=ShutdownProcess(process_matcher=matcher))
