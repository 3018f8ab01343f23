"""The period of actionlib's status topic, in the node's clock."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from gazelle.graph.errors import TimeJumpError

if TYPE_CHECKING:
    from gazelle.graph.clock import Clock

__all__ = ["StatusTimer"]


class StatusTimer:
    """Calls back once a period, from a thread of its own or when `tick` finds it due."""

    def __init__(
        self, period_ns: int, now_ns: Callable[[], int], callback: Callable[[], None]
    ) -> None:
        """Begin at the clock's time; a period of 0 never comes."""
        self._period_ns = period_ns
        self._now_ns = now_ns
        self._callback = callback
        self._last_ns = now_ns()
        self._closed = False

    def start(self, clock: Clock, name: str) -> None:
        """Keep the period in a thread, on a node's clock."""
        if self._period_ns:
            threading.Thread(
                target=self._loop, args=(clock,), name=f"status {name}", daemon=True
            ).start()

    def tick(self) -> None:
        """Call back when the period is over, or time went back."""
        if self._period_ns and not 0 <= self._now_ns() - self._last_ns < self._period_ns:
            self._last_ns = self._now_ns()
            self._callback()

    def close(self) -> None:
        """Call back no more."""
        self._closed = True
        self._period_ns = 0

    def _loop(self, clock: Clock) -> None:
        while not self._closed:
            try:
                if not clock.sleep(self._period_ns):
                    return
            except TimeJumpError:
                continue
            if not self._closed:
                self._callback()
