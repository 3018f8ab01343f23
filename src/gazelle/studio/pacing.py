"""Data that come as they like, shown at most so often."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from gazelle.studio.streams import Channel

__all__ = ["Pace", "every"]


class Pace:
    """Lets something happen at most `rate_hz` times a second, the last one never lost."""

    def __init__(self, channel: Channel, act: Callable[[], None], rate_hz: float) -> None:
        """Call `act` in the thread that is due or in the event loop; it must be short."""
        self._channel = channel
        self._act = act
        self._period_s = 1.0 / rate_hz
        self._lock = threading.Lock()
        self._due_s = 0.0
        self._waiting = False

    def __call__(self) -> None:
        """Something new is there."""
        now_s = time.monotonic()
        with self._lock:
            if self._waiting:
                return
            wait_s = self._due_s - now_s
            if wait_s > 0:
                self._waiting = True
            else:
                self._due_s = now_s + self._period_s
        if wait_s > 0:
            self._channel.later(wait_s, self._late)
        else:
            self._act()

    def _late(self) -> None:
        with self._lock:
            self._waiting = False
            self._due_s = time.monotonic() + self._period_s
        if not self._channel.closed:
            self._act()


def every(channel: Channel, period_s: float, act: Callable[[], None]) -> None:
    """Call `act` now and so often until the channel closes; in the event loop, so be short."""

    def again() -> None:
        if not channel.closed:
            act()
            channel.later(period_s, again)

    again()
