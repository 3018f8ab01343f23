"""ROS's half of the bridge: a process of ours, and the commands, messages and calls for it."""

from __future__ import annotations

import itertools
import subprocess
import threading
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from gazelle.bridge.ros2.interpreters import Interpreter, child_environment, sourced_hint
from gazelle.bridge.ros2.rclpy_side.pipes import Frame, FrameKind, Pipes
from gazelle.errors import GraphError
from gazelle.graph.errors import ServiceRefusedError, coded

__all__ = ["About", "LinkListener", "Outcome", "RclpyLink", "RclpyProcess", "start_rclpy"]

_SCRIPT = Path(__file__).parent / "rclpy_side" / "run.py"
_START_S = 60.0
_END_S = 3.0


class Outcome(NamedTuple):
    """How a command went.

    Attributes:
        error: why it failed, empty when it did not.
        missing: ROS has no such type.
        type_hash: of the type as ROS has built it, empty where it does not tell.
    """

    error: str
    missing: bool
    type_hash: str


class LinkListener(Protocol):
    """Who is told what comes; all methods are called from one thread and must not wait for it."""

    def on_state(self, state: dict[str, Any]) -> None:
        """What there is in ROS has changed."""

    def on_done(self, channel: int, outcome: Outcome) -> None:
        """A command was carried out, or not."""

    def on_message(self, channel: int, number: int, cdr: bytes) -> None:
        """A publisher, told by its number, has sent a message."""

    def on_request(self, channel: int, number: int, cdr: bytes) -> None:
        """Somebody in ROS calls a service."""

    def on_end(self) -> None:
        """ROS's half has gone."""


class _Call:
    def __init__(self, channel: int) -> None:
        self.channel = channel
        self.over = threading.Event()
        self.data = b""
        self.error = ""


class RclpyLink:
    """One connection; safe to use from many threads. After its end it does nothing."""

    def __init__(self, pipes: Pipes, listener: LinkListener) -> None:
        """Begin to listen."""
        self._pipes = pipes
        self._listener = listener
        self._channels = itertools.count(1)
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._calls: dict[int, _Call] = {}
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="ros2 link", daemon=True)

    def start(self) -> None:
        """Begin to tell the hearer."""
        self._thread.start()

    def do(self, command: str, **fields: Any) -> int:
        """Give a command; return the channel that is made by it."""
        channel = next(self._channels)
        self._send_control(do=command, channel=channel, **fields)
        return channel

    def drop(self, channel: int) -> None:
        """Give a channel up."""
        self._send_control(do="drop", channel=channel)
        self.fail_calls(channel, "it has gone")

    def publish(self, channel: int, cdr: bytes) -> None:
        """Send a message."""
        self._send(FrameKind.MESSAGE, channel, 0, cdr)

    def call(self, channel: int, cdr: bytes) -> bytes:
        """Call a service and wait as long as it lives.

        Raises:
            ServiceRefusedError: it gave no answer.
        """
        call, number = _Call(channel), next(self._numbers)
        with self._lock:
            if self._ended:
                raise ServiceRefusedError("the bridge to ROS 2 is down")
            self._calls[number] = call
        self._send(FrameKind.REQUEST, channel, number, cdr)
        call.over.wait()
        if call.error:
            raise ServiceRefusedError(call.error)
        return call.data

    def respond(self, channel: int, number: int, cdr: bytes | None) -> None:
        """Answer a call from ROS; None gives it no answer."""
        kind = FrameKind.FAILURE if cdr is None else FrameKind.RESPONSE
        self._send(kind, channel, number, cdr or b"")

    def fail_calls(self, channel: int | None, reason: str) -> None:
        """End the waiting for a channel's answers, for all with None."""
        with self._lock:
            gone = [n for n, one in self._calls.items() if channel in (None, one.channel)]
            calls = [self._calls.pop(number) for number in gone]
        for call in calls:
            call.error = reason
            call.over.set()

    def _send_control(self, **fields: Any) -> None:
        try:
            self._pipes.send_control(**fields)
        except (OSError, ValueError):
            # It has gone; the thread that listens finds that out and tells.
            self._ended = True

    def _send(self, kind: int, channel: int, number: int, data: bytes) -> None:
        try:
            self._pipes.send(kind, channel, number, data)
        except (OSError, ValueError):
            self._ended = True

    def _run(self) -> None:
        try:
            while True:
                self._hear(self._pipes.receive())
        except (EOFError, OSError, ValueError):
            with self._lock:
                self._ended = True
            self.fail_calls(None, "the bridge's half in ROS 2 has ended")
            self._listener.on_end()

    def _hear(self, frame: Frame) -> None:
        kind, channel, number, data = frame
        if kind == FrameKind.MESSAGE:
            self._listener.on_message(channel, number, data)
        elif kind == FrameKind.REQUEST:
            self._listener.on_request(channel, number, data)
        elif kind == FrameKind.CONTROL:
            self._report(frame.control())
        else:
            self._finish(number, data, is_failure=kind == FrameKind.FAILURE)

    def _report(self, report: dict[str, Any]) -> None:
        if report.pop("report") == "state":
            self._listener.on_state(report)
        else:
            self._listener.on_done(report.pop("channel"), Outcome(**report))

    def _finish(self, number: int, data: bytes, *, is_failure: bool) -> None:
        with self._lock:
            call = self._calls.pop(number, None)
        if call is not None:
            call.data = data
            call.error = data.decode("utf-8", "replace") if is_failure else ""
            call.over.set()


class About(NamedTuple):
    """What ROS's half says of itself.

    Attributes:
        python: its interpreter.
        rmw: the middleware, such as ``rmw_fastrtps_cpp``.
        distro: ``ROS_DISTRO``, empty where it is not set.
        pid: its process.
        prefixes: folders that may have ``share/<package>/msg``.
    """

    python: str
    rmw: str
    distro: str
    pid: int
    prefixes: tuple[str, ...]


class _StartError(Exception):
    """This Python has no ROS 2; the text says why."""


class RclpyProcess:
    """The running process.

    Attributes:
        about: what it is.
        pipes: to talk over.
    """

    def __init__(self, interpreter: Interpreter, environ: Mapping[str, str]) -> None:
        """Start the process and wait until it has opened ROS.

        Raises:
            _StartError: it could not.
        """
        try:
            self._process = subprocess.Popen(
                [interpreter.path, str(_SCRIPT)],
                env=child_environment(environ),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
            )
        except OSError as error:
            raise _StartError(str(error)) from error
        assert self._process.stdin is not None and self._process.stdout is not None
        self.pipes = Pipes(self._process.stdout, self._process.stdin)
        self.about = self._first_words()

    @property
    def exit_text(self) -> str:
        """How it ended, for people."""
        code = self._process.poll()
        return "it is still there" if code is None else f"exit code {code}"

    def close(self) -> None:
        """End the process."""
        try:
            self.pipes.close()
            self._process.wait(_END_S)
        except (OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()

    def _first_words(self) -> About:
        watchdog = threading.Timer(_START_S, self._process.kill)
        watchdog.start()
        try:
            report = self.pipes.receive().control()
        except (EOFError, ValueError) as error:
            self.close()
            raise _StartError(f"it ended before it said anything ({self.exit_text})") from error
        finally:
            watchdog.cancel()
        if report["report"] == "failed":
            self.close()
            raise _StartError(report["error"])
        prefixes = tuple(report["prefixes"])
        return About(report["python"], report["rmw"], report["distro"], report["pid"], prefixes)


def start_rclpy(
    interpreters: Iterable[Interpreter],
    environ: Mapping[str, str],
    hint: Callable[[Mapping[str, str]], str] = sourced_hint,
) -> RclpyProcess:
    """Start ROS's half with the first Python that can.

    Args:
        interpreters: to try.
        environ: the environment.
        hint: what to do when there is none.

    Raises:
        GraphError: none can; the text says why each cannot.
    """
    reasons = []
    for one in interpreters:
        try:
            return RclpyProcess(one, environ)
        except _StartError as error:
            reasons.append(f"  {one.path} ({one.source}): {error}")
    text = coded("bridge.no-rclpy", "no Python with ROS 2's rclpy was found", fix=hint(environ))
    first, *rest = text.splitlines()
    raise GraphError("\n".join([first, *reasons, *rest]))
