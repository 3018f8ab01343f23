"""Rate, Timer and sleep on the node's clock (rospy.timer)."""

from __future__ import annotations

import threading
import time as wall_time
from collections.abc import Callable
from typing import Any

from gazelle.compat.rospy.exceptions import (
    ROSInterruptException,
    ROSTimeMovedBackwardsException,
)
from gazelle.compat.rospy.rostime import Duration, Time, get_rostime
from gazelle.compat.rospy.state import STATE
from gazelle.graph import TimeJumpError
from gazelle.interfaces import Duration as _Duration
from gazelle.interfaces import Time as _Time

__all__ = ["Rate", "Timer", "TimerEvent", "sleep"]


def sleep(duration: float | _Duration) -> None:
    """Sleep on the node's clock; a negative duration returns at once.

    As in rospy only a sleep in simulated time tells of the shutdown. One in wall time is cut short
    by it, and what a program does after its loop may sleep.

    Raises:
        ROSInterruptException: the node was shut down meanwhile, or before.
        ROSTimeMovedBackwardsException: simulated time jumped back.
    """
    seconds_ns = duration.to_nsec() if isinstance(duration, _Duration) else int(duration * 1e9)
    node = STATE.require("rospy.sleep")
    if seconds_ns <= 0:
        return
    if not node.clock.use_sim_time:
        STATE.sleep(seconds_ns / 1e9)
        return
    STATE.check_running()
    try:
        done = node.clock.sleep(seconds_ns)
    except TimeJumpError as error:
        raise ROSTimeMovedBackwardsException(error.delta_ns / 1e9) from error
    if not done:
        raise ROSInterruptException("ROS shutdown request")


class Rate:
    """Sleeps so that a loop runs at a frequency.

    Args:
        hz: frequency.
        reset: start anew instead of raising when simulated time jumps back.
    """

    def __init__(self, hz: float, reset: bool = False) -> None:
        self.last_time: Time = get_rostime()
        self.sleep_dur = Duration(0, int(1e9 / hz))
        self._reset = reset

    def remaining(self) -> _Duration:
        """Return how long `sleep` would take now."""
        return self._remaining(get_rostime())

    def sleep(self) -> None:
        """Sleep for what is left of the period.

        Raises:
            ROSInterruptException: the node was shut down meanwhile.
            ROSTimeMovedBackwardsException: simulated time jumped back.
        """
        now = get_rostime()
        try:
            sleep(self._remaining(now))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.last_time = get_rostime()
            return
        self.last_time = Time(nsecs=self.last_time.to_nsec() + self.sleep_dur.to_nsec())
        # A loop that takes longer than two periods does not try to catch up.
        if now.to_nsec() - self.last_time.to_nsec() > self.sleep_dur.to_nsec() * 2:
            self.last_time = now

    def _remaining(self, now: _Time) -> _Duration:
        if self.last_time > now:
            self.last_time = Time(now.secs, now.nsecs)
        elapsed_ns = now.to_nsec() - self.last_time.to_nsec()
        return Duration(nsecs=self.sleep_dur.to_nsec() - elapsed_ns)


class TimerEvent:
    """What a `Timer` tells its callback.

    Attributes:
        last_expected, last_real: when the previous callback should have begun and did, or None.
        current_expected, current_real: the same for this one.
        last_duration: seconds the previous callback took, or None.
    """

    def __init__(
        self,
        last_expected: Time | None,
        last_real: Time | None,
        current_expected: Time,
        current_real: Time,
        last_duration: float | None,
    ) -> None:
        self.last_expected = last_expected
        self.last_real = last_real
        self.current_expected = current_expected
        self.current_real = current_real
        self.last_duration = last_duration


class Timer(threading.Thread):
    """Calls a function again and again on the node's clock, in a thread of its own.

    Args:
        period: between calls.
        callback: takes a `TimerEvent`.
        oneshot: call once.
        reset: start anew instead of ending when simulated time jumps back.
    """

    def __init__(
        self,
        period: _Duration,
        callback: Callable[[TimerEvent], Any],
        oneshot: bool = False,
        reset: bool = False,
    ) -> None:
        super().__init__(daemon=True)
        self._period = period
        self._callback = callback
        self._oneshot = oneshot
        self._shutdown = threading.Event()
        # Time counts from here, not from when the thread gets to run.
        self._rate = Rate(1e9 / period.to_nsec(), reset=reset)
        self._expected = get_rostime() + period
        self.start()

    def shutdown(self) -> None:
        """Call the function no more."""
        self._shutdown.set()

    def run(self) -> None:
        """Loop until shut down."""
        rate, expected = self._rate, self._expected
        last_expected: Time | None = None
        last_real: Time | None = None
        last_duration: float | None = None
        while not STATE.stopping.is_set() and not self._shutdown.is_set():
            try:
                rate.sleep()
            except ROSInterruptException:
                break
            if self._shutdown.is_set() or STATE.stopping.is_set():
                break
            real = get_rostime()
            start = wall_time.monotonic()
            self._callback(TimerEvent(last_expected, last_real, expected, real, last_duration))
            if self._oneshot:
                break
            last_duration = wall_time.monotonic() - start
            last_expected, last_real = expected, real
            expected = expected + self._period
