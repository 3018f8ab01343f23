"""How often a controller publishes, counted in the time of the control loop."""

from __future__ import annotations

import math
from fractions import Fraction

__all__ = ["PublishRate"]

_NS_PER_S = 1_000_000_000


class PublishRate:
    """Tells at every update whether a message is due; on average exactly at the rate.

    ros_control counts ``last + period < now`` and adds one period to `last` at each message, so a
    message is never left out and late ones do not move the following.
    """

    def __init__(self, rate_hz: float, *, at_once: bool = False) -> None:
        """Set the rate.

        Args:
            rate_hz: 0 or less never publishes.
            at_once: the first message comes with the first update, as joint_state_controller has
                it (which starts 1.001 periods ago); otherwise it comes after the first period.
        """
        self._period_ns = Fraction(0)
        if rate_hz > 0.0:
            self._period_ns = Fraction(_NS_PER_S) / Fraction(rate_hz).limit_denominator(1_000_000)
        self._at_once = at_once
        self._last_ns: Fraction | None = None
        self._next_ns = 0

    def start(self, time_ns: int) -> None:
        """Begin to count with the next update.

        With `at_once` a second start goes on counting, unless time went back. ROS calls
        ``starting`` at the time of the first update; here a paused world may lie between.
        """
        if self._last_ns is None or not self._at_once or self._last_ns > time_ns:
            self._last_ns, self._next_ns = None, 0

    def due(self, time_ns: int) -> bool:
        """Tell whether to publish now, and count it."""
        if self._last_ns is None:
            return self._begin(time_ns)
        if time_ns <= self._next_ns:
            return False
        self._advance_to(self._last_ns + self._period_ns)
        return True

    def _begin(self, time_ns: int) -> bool:
        if not self._period_ns:
            return False
        early = self._period_ns * 1001 / 1000 if self._at_once else Fraction(0)
        self._advance_to(time_ns - early)
        return self._at_once and self.due(time_ns)

    def _advance_to(self, last_ns: Fraction) -> None:
        self._last_ns = last_ns
        # Times are whole: later than the exact one is later than the whole one below it.
        self._next_ns = math.floor(last_ns + self._period_ns)
