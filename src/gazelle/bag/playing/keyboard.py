"""Keys while a bag plays: space pauses, s steps."""

from __future__ import annotations

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Iterator

__all__ = ["keyboard"]

_LOOK_S = 0.2


@contextlib.contextmanager
def keyboard(on_key: Callable[[str], None]) -> Iterator[None]:
    """Call `on_key` with every key pressed inside the block; the terminal is put back after it.

    Where standard input is no terminal, or the shell runs this in the background (``&``), nothing
    is read: the system would stop a background process that touches its terminal.
    """
    if not sys.stdin or not sys.stdin.isatty() or not _is_in_front():
        yield
        return
    import termios
    import tty

    number, ended = sys.stdin.fileno(), threading.Event()
    before = termios.tcgetattr(number)

    def read() -> None:
        while not ended.is_set():
            ready, _, _ = select.select([number], [], [], _LOOK_S)
            if ready:
                on_key(sys.stdin.read(1))

    tty.setcbreak(number)
    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    try:
        yield
    finally:
        ended.set()
        reader.join(2 * _LOOK_S)
        termios.tcsetattr(number, termios.TCSADRAIN, before)


def _is_in_front() -> bool:
    """Return whether the terminal's keys are for this process."""
    return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
