"""Pause and step, from the keyboard or from services."""

from __future__ import annotations

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Iterator

__all__ = ["Controls", "keyboard"]


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


class Controls:
    """What the user wants while a bag plays; safe to use from any thread."""

    def __init__(self, *, paused: bool = False) -> None:
        """Start paused or not."""
        self._changed = threading.Condition()
        self._paused = paused
        self._steps = 0
        self._stopped = False

    @property
    def paused(self) -> bool:
        """Whether playing stands still."""
        return self._paused

    @property
    def stopped(self) -> bool:
        """Whether playing is to end."""
        return self._stopped

    def toggle(self) -> None:
        """Pause, or go on."""
        self.pause(not self._paused)

    def pause(self, paused: bool) -> None:
        """Pause or go on, as told."""
        with self._changed:
            self._paused = paused
            self._changed.notify_all()

    def step(self) -> None:
        """Play one message while paused."""
        with self._changed:
            self._steps += 1
            self._changed.notify_all()

    def stop(self) -> None:
        """End playing."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def take_step(self) -> bool:
        """Return whether a step was asked for, once for each."""
        with self._changed:
            taken = self._steps > 0
            self._steps -= taken
            return taken

    def wait(self, seconds: float) -> None:
        """Wait, but no longer than until something is wanted."""
        with self._changed:
            if not self._stopped and not self._steps:
                self._changed.wait(seconds)
