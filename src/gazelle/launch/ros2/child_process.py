"""A process of a launch: its start in the event loop, its output line by line, its end."""

from __future__ import annotations

import asyncio
import codecs
import contextlib
import logging
import os
import pty
import sys
from collections.abc import Callable, Coroutine, Generator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.launch.environment import is_own_command
from gazelle.launch.watchdog import Watchdog
from gazelle.process_lifetime import PARENT_VARIABLE, interrupts_held

__all__ = ["ChildProcess", "OutputLines", "WatchedGroups", "start_child"]

# What a process wrote last is awaited so long, since a child of it may hold its output open.
_LAST_OUTPUT_S = 0.5


class OutputLines:
    """Cuts the output of a process into lines and logs each as soon as it ends."""

    def __init__(
        self, logger: logging.Logger, format_line: Callable[[str], str], *, is_cached: bool
    ) -> None:
        self._logger = logger
        self._format_line = format_line
        self._is_cached = is_cached
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._part = ""
        self._all: list[str] = []

    def add(self, data: bytes) -> None:
        """Take more of the output."""
        text = self._decoder.decode(data)
        if self._is_cached:
            self._all.append(text)
        *lines, self._part = (self._part + text).split("\n")
        for line in lines:
            self._logger.info(self._format_line(line.removesuffix("\r")))

    def end(self) -> None:
        """Log what has no line end behind it."""
        if self._part:
            self._logger.info(self._format_line(self._part))
        self._part = ""

    def text(self) -> str:
        """Return all of it so far; empty unless it is cached."""
        return "".join(self._all)


@dataclass(frozen=True, slots=True)
class WatchedGroups:
    """Process groups that end with the launcher, whatever ends it.

    Attributes:
        watchdog: the process that watches.
        groups: those that may have something left in them.
    """

    watchdog: Watchdog
    groups: set[int]

    def begun(self, group: int) -> None:
        """Watch over a group."""
        self.groups.add(group)
        self.watchdog.begun(group)

    def ended(self, group: int) -> None:
        """Forget a group, unless something in it still runs."""
        if not _is_there(group):
            self.groups.discard(group)
            self.watchdog.ended(group)

    def close(self) -> None:
        """End what is left, and wait for that."""
        for group in list(self.groups):
            self.ended(group)
        self.watchdog.close()


class ChildProcess(asyncio.SubprocessProtocol):
    """A process that has been started; output and end are told as they come.

    Attributes:
        complete: its exit code, when it has ended and its output is read.
        transport: asyncio's handle of it.
    """

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        on_start: Callable[[ChildProcess], None],
        on_output: Callable[[int, bytes], None],
    ) -> None:
        self.complete: asyncio.Future[int] = loop.create_future()
        self.transport: Any = None
        self._loop = loop
        self._on_start = on_start
        self._on_output = on_output
        self._open = {1, 2}
        self._terminals: list[asyncio.BaseTransport] = []

    @property
    def pid(self) -> int:
        """Its number."""
        return int(self.transport.get_pid())

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Hear that it has been started."""
        self.transport = transport
        self._on_start(self)

    def pipe_data_received(self, fd: int, data: bytes | str) -> None:
        """Hear what it wrote."""
        self._on_output(fd, data if isinstance(data, bytes) else data.encode())

    def pipe_connection_lost(self, fd: int, exc: Exception | None) -> None:
        """Hear that nothing more comes from standard output or error."""
        self._open.discard(fd)
        self._finish_when_silent()

    def process_exited(self) -> None:
        """Hear that it has ended."""
        self._finish_when_silent()
        self._loop.call_later(_LAST_OUTPUT_S, self._finish)

    def send_signal(self, number: int, *, whole_group: bool = False) -> None:
        """Send it a signal, or it and everything it has started.

        Raises:
            ProcessLookupError: it has ended.
        """
        if whole_group:
            os.killpg(self.pid, number)
        else:
            self.transport.send_signal(number)

    def write(self, data: bytes) -> None:
        """Give it something to read on standard input."""
        stdin = self.transport.get_pipe_transport(0)
        if stdin is not None and not stdin.is_closing():
            stdin.write(data)

    def close(self) -> None:
        """Close its pipes; a process that still runs is killed."""
        self.transport.close()
        for terminal in self._terminals:
            terminal.close()

    async def read_terminal(self, fd: int, terminal: int) -> None:
        """Take standard output or error from a terminal of its own."""
        stream = os.fdopen(terminal, "rb", buffering=0)
        transport, _ = await self._loop.connect_read_pipe(lambda: _Terminal(self, fd), stream)
        self._terminals.append(transport)

    def _finish_when_silent(self) -> None:
        if not self._open and self.transport.get_returncode() is not None:
            self._finish()

    def _finish(self) -> None:
        if not self.complete.done():
            self.complete.set_result(self.transport.get_returncode())


async def start_child(
    on_start: Callable[[ChildProcess], None],
    on_output: Callable[[int, bytes], None],
    *,
    cmd: Sequence[str],
    cwd: str | None,
    env: Mapping[str, str] | None,
    shell: bool,
    emulate_tty: bool,
) -> ChildProcess:
    """Start a process in a session of its own, so that the launcher decides on its end.

    Args:
        on_start: is told of the process before anything else is told of it.
        on_output: is told file descriptor (1 or 2) and bytes of everything it writes.
        cmd: its words.
        cwd: its folder, None for the launcher's.
        env: its environment, None for the launcher's.
        shell: give the words to a shell, joined by blanks.
        emulate_tty: let it write to terminals instead of pipes.

    Raises:
        OSError: it cannot be started.
    """
    loop = asyncio.get_running_loop()
    variables = dict(os.environ if env is None else env)
    variables.pop(PARENT_VARIABLE, None)
    if cmd[0] == sys.executable and not shell:
        # Behind a shell or a prefix a node would take these for its launcher, and end at once.
        variables[PARENT_VARIABLE] = str(os.getpid())
    terminals = [(fd, *pty.openpty()) for fd in (1, 2)] if emulate_tty else []
    outputs = {fd: far for fd, _near, far in terminals}
    options: dict[str, Any] = {
        "stdout": outputs.get(1, asyncio.subprocess.PIPE),
        "stderr": outputs.get(2, asyncio.subprocess.PIPE),
        "cwd": cwd,
        "env": variables,
        "start_new_session": True,
    }
    started = lambda: ChildProcess(loop, on_start, on_output)  # noqa: E731
    starting = (
        loop.subprocess_shell(started, " ".join(cmd), **options)
        if shell
        else loop.subprocess_exec(started, *cmd, **options)
    )
    try:
        holds = is_own_command(cmd, variables.get("PATH"))
        _, child = await (_Held(starting) if holds else starting)
    except BaseException:
        for _fd, near, _far in terminals:
            os.close(near)
        raise
    finally:
        for _fd, _near, far in terminals:
            os.close(far)
    for fd, near, _far in terminals:
        await child.read_terminal(fd, near)
    return child


class _Terminal(asyncio.Protocol):
    """The launcher's end of a process's terminal."""

    def __init__(self, child: ChildProcess, fd: int) -> None:
        self._child = child
        self._fd = fd

    def data_received(self, data: bytes) -> None:
        # The line discipline writes a carriage return before each line feed.
        self._child.pipe_data_received(self._fd, data.replace(b"\r\n", b"\n"))

    def connection_lost(self, exc: Exception | None) -> None:
        self._child.pipe_connection_lost(self._fd, exc)


class _Held:
    """Starts a process with SIGINT held, and lets it go before anything else has its turn."""

    def __init__(self, starting: Coroutine[Any, Any, Any]) -> None:
        self._starting = starting

    def __await__(self) -> Generator[Any, None, Any]:
        with interrupts_held():
            # The process is started in the first step; all others wait for its pipes.
            try:
                awaited = self._starting.send(None)
            except StopIteration as done:
                return done.value
        while True:
            caught: BaseException | None = None
            sent: Any = None
            try:
                sent = yield awaited
            except BaseException as error:  # noqa: BLE001 - it is the coroutine's to handle
                caught = error
            try:
                go_on = self._starting
                awaited = go_on.send(sent) if caught is None else go_on.throw(caught)
            except StopIteration as done:
                return done.value


def _is_there(group: int) -> bool:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(group, 0)
        return True
    return False
