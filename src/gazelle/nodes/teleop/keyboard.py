"""Keys of the terminal, one at a time, and its settings put back at the end."""

from __future__ import annotations

import contextlib
import os
import select
import sys
import termios
from types import TracebackType
from typing import Any, Self

from gazelle.errors import LaunchError

__all__ = ["CTRL_C", "Keys", "say"]

CTRL_C = "\x03"
_LOCAL_FLAGS = 3


class Keys:
    """The keyboard as a context: inside it, keys come at once and are not shown.

    Args:
        program: its name, for the message without a terminal.
        takes_ctrl_c: Ctrl-C is a key too; else it interrupts, as usual.

    Raises:
        LaunchError: on entering, when standard input is no terminal.
    """

    def __init__(self, program: str, *, takes_ctrl_c: bool) -> None:
        """Remember; the terminal changes on entering."""
        self._program = program
        self._taken = termios.ICANON | termios.ECHO | (termios.ISIG if takes_ctrl_c else 0)
        self._descriptor = -1
        self._before: list[Any] = []

    def __enter__(self) -> Self:
        """Take the keyboard."""
        try:
            self._descriptor = sys.stdin.fileno()
            self._before = termios.tcgetattr(self._descriptor)
        except (AttributeError, OSError, ValueError, termios.error) as error:
            raise LaunchError(
                f"{self._program} reads the keyboard, and standard input is no terminal: start it "
                "in a terminal of its own, without a pipe, '&' or nohup\n"
                "  ROS says: termios.error: (25, 'Inappropriate ioctl for device')"
            ) from error
        # Output stays as it is: other nodes write to the same terminal.
        changed = list(self._before)
        changed[_LOCAL_FLAGS] &= ~self._taken
        termios.tcsetattr(self._descriptor, termios.TCSADRAIN, changed)
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        """Put the settings back, if the terminal is still there."""
        with contextlib.suppress(termios.error):
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._before)

    def read(self, timeout_s: float) -> str | None:
        """Return the next key, empty when none comes in time, None when the terminal is gone."""
        ready, _, _ = select.select([self._descriptor], [], [], timeout_s)
        if not ready:
            return ""
        try:
            data = os.read(self._descriptor, 1)
        except OSError:
            return None
        return data.decode("latin-1") or None


def say(text: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()
