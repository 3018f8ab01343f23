"""How long to wait for simulated time that has to be looked at."""

from __future__ import annotations

import time

__all__ = ["Waits"]

_MIN_DURATION_S = 0.0005
_MAX_DURATION_S = 0.1
# What is so far off is met by halves, for time may come to run faster meanwhile.
_NEAR_S = 0.04
# Time that stands still comes on soon, or with word of it: publishers give that after 50 ms, and
# so many looks take twice as long.
_STILL_LOOKS = 28
_STILL_S = (0.0005, 0.001, 0.002, 0.004)
_LONG_STILL_S = 0.05
_WINDOW_S = 0.1
_MAX_SPEED = 100.0
# A simulator takes some steps at a time. Who sleeps for less than those misses them on a page.
_SHORT_NS = 2_500_000
_MANY = 200


class Waits:
    """Reckons, from how fast simulated time ran of late, when it is worth looking again.

    Looking early costs a look, some microseconds; looking late makes whoever waits late. So time
    that runs slowly is expected to run at the wall's speed from now on.
    """

    def __init__(self) -> None:
        self._rates = (1.0, 1.0)
        self._mark_ns = 0
        self._mark_s = 0.0
        self._short = 0
        self._mostly_short = False

    def begin(self, left_ns: int) -> bool:
        """Take in how long a sleep will be; return whether most are too short for a page.

        Messages tell of each step, one after the other.
        """
        self._short = min(max(self._short + (1 if left_ns < _SHORT_NS else -1), 0), _MANY)
        if self._short in (0, _MANY):
            self._mostly_short = self._short == _MANY
        return self._mostly_short

    def until(self, left_ns: int) -> float:
        """Return how many seconds to wait before looking, with so much simulated time left."""
        left_s = left_ns * 1e-9 / max(self._rates)
        if left_s > _NEAR_S:
            left_s = min(left_s / 2, _MAX_DURATION_S)
        return max(left_s, _MIN_DURATION_S)

    def still(self, looks: int) -> float:
        """Return how many seconds to wait while time stands still.

        Args:
            looks: how many have seen that.
        """
        if looks > _STILL_LOOKS:
            return _LONG_STILL_S
        return _STILL_S[min(looks, len(_STILL_S)) - 1]

    def note(self, now_ns: int) -> None:
        """Take in what a look has shown."""
        now_s = time.monotonic()
        since_s = now_s - self._mark_s
        if since_s < _WINDOW_S:
            return
        rate = (now_ns - self._mark_ns) * 1e-9 / since_s
        self._rates = (self._rates[1], min(max(rate, 1.0), _MAX_SPEED))
        self._mark_ns, self._mark_s = now_ns, now_s
