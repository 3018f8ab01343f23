"""Pause and step, from the keyboard or from services."""

from __future__ import annotations

import threading

__all__ = ["Controls"]


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
