"""ROS's half of the bridge as a process of ours."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from gazelle.bridge.ros2.interpreters import Interpreter, child_environment, sourced_hint
from gazelle.bridge.ros2.rclpy_side.frames import Pipes
from gazelle.errors import GraphError
from gazelle.graph.errors import coded

__all__ = ["About", "Side", "open_side"]

_SCRIPT = Path(__file__).parent / "rclpy_side" / "run.py"
_START_S = 60.0
_END_S = 3.0


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


class Side:
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
            words = self.pipes.receive().control()
        except (EOFError, ValueError) as error:
            self.close()
            raise _StartError(f"it ended before it said anything ({self.exit_text})") from error
        finally:
            watchdog.cancel()
        if words["report"] == "failed":
            self.close()
            raise _StartError(words["error"])
        prefixes = tuple(words["prefixes"])
        return About(words["python"], words["rmw"], words["distro"], words["pid"], prefixes)


def open_side(
    interpreters: Iterable[Interpreter],
    environ: Mapping[str, str],
    hint: Callable[[Mapping[str, str]], str] = sourced_hint,
) -> Side:
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
            return Side(one, environ)
        except _StartError as error:
            reasons.append(f"  {one.path} ({one.source}): {error}")
    text = coded("bridge.no-rclpy", "no Python with ROS 2's rclpy was found", fix=hint(environ))
    first, *rest = text.splitlines()
    raise GraphError("\n".join([first, *reasons, *rest]))
