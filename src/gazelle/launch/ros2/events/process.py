"""launch.events.process."""

from __future__ import annotations

import signal as _signal
from collections.abc import Callable
from typing import Any

from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.utilities import ensure_argument_type

__all__ = [
    "ProcessExited",
    "ProcessIO",
    "ProcessStarted",
    "ProcessStderr",
    "ProcessStdin",
    "ProcessStdout",
    "ProcessTargetedEvent",
    "RunningProcessEvent",
    "ShutdownProcess",
    "SignalProcess",
    "matches_executable",
    "matches_name",
    "matches_pid",
]


class RunningProcessEvent(Event):
    """Something happened to a process.

    Attributes:
        action: the action that started it.
        execute_process_action: the same (Foxy's name).
        process_name: such as ``talker-1``.
        cmd: its words.
        cwd: its folder, None for the launcher's own.
        env: its environment.
        pid: its number.
    """

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self,
        *,
        action: Any,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None:
        super().__init__()
        self.action = action
        self.execute_process_action = action
        self.process_name = name
        self.cmd = cmd
        self.cwd = cwd
        self.env = env
        self.pid = pid


class ProcessStarted(RunningProcessEvent):
    """A process runs."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """A process has ended.

    Attributes:
        returncode: its exit code, negative for a signal.
    """

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    """A process wrote or is to read something.

    Attributes:
        text: the bytes.
        fd: 0, 1 or 2.
        from_stdin: it is to read them.
        from_stdout: it wrote them to standard output.
        from_stderr: it wrote them to standard error.
    """

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.text = text
        self.fd = fd
        self.from_stdin = fd == 0
        self.from_stdout = fd == 1
        self.from_stderr = fd == 2


class ProcessStdin(ProcessIO):
    """A process is to read something."""

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=0, **kwargs)


class ProcessStdout(ProcessIO):
    """A process wrote to standard output."""

    name = "launch.events.process.ProcessStdout"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=1, **kwargs)


class ProcessStderr(ProcessIO):
    """A process wrote to standard error."""

    name = "launch.events.process.ProcessStderr"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=2, **kwargs)


class ProcessTargetedEvent(Event):
    """Something is to be done to the processes that a matcher picks.

    Attributes:
        process_matcher: is given the action of each process.
    """

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        super().__init__()
        self.process_matcher = process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    """Processes are to end: SIGINT, then SIGTERM, then SIGKILL."""

    name = "launch.events.process.ShutdownProcess"


class SignalProcess(ProcessTargetedEvent):
    """Processes are to get a signal.

    Attributes:
        signal: the signal, or ``'SIGKILL'``.
        signal_name: its name.
    """

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: str | _signal.Signals, process_matcher: Callable[[Any], bool]
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        ensure_argument_type(
            signal_number, (str, _signal.Signals), "signal_number", "SignalProcess"
        )
        self.signal = signal_number
        self.signal_name = signal_number if isinstance(signal_number, str) else signal_number.name


def matches_pid(pid: int) -> Callable[[Any], bool]:
    """Return a matcher for the process with a number."""
    return lambda action: _detail(action, "pid") == pid


def matches_name(name: str) -> Callable[[Any], bool]:
    """Return a matcher for the process with a name such as ``talker-1``."""
    return lambda action: _detail(action, "name") == name


def matches_executable(executable: str) -> Callable[[Any], bool]:
    """Return a matcher for processes whose first word ends in a text."""
    return lambda action: str((_detail(action, "cmd") or [""])[0]).endswith(executable)


def _detail(action: Any, name: str) -> Any:
    return None if action.process_details is None else action.process_details.get(name)
