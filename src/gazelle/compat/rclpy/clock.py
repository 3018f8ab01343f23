"""Clocks (rclpy.clock)."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

from gazelle.compat.rclpy.context import Context, get_default_context
from gazelle.compat.rclpy.duration import Duration
from gazelle.compat.rclpy.exceptions import NotInitializedException
from gazelle.compat.rclpy.time import ClockType, Time
from gazelle.compat.warn_once import warn_once
from gazelle.graph import Clock as GraphClock
from gazelle.graph import TimeJumpError

__all__ = ["Clock", "ClockChange", "JumpThreshold", "ROSClock", "TimeJump"]

_SLICE_NS = 100_000_000


@dataclass(frozen=True, kw_only=True)
class JumpThreshold:
    """Which jumps a callback hears of; of jumps forward this graph tells nobody.

    Attributes:
        min_forward: the shortest one forward, None for none.
        min_backward: the shortest one backwards, less than nothing; None for none.
        on_clock_change: hear as well when the source of time changes.

    Raises:
        ValueError: a threshold has the wrong sign, or there is none.
    """

    min_forward: Duration | None = None
    min_backward: Duration | None = None
    on_clock_change: bool = True

    def __post_init__(self) -> None:
        """Refuse what rclpy refuses."""
        if self.min_forward is not None and self.min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if self.min_backward is not None and self.min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if self.min_forward is None and self.min_backward is None and not self.on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")


class ClockChange(IntEnum):
    """Which source of time a clock had before a jump and has after it."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class TimeJump(NamedTuple):
    """A jump of simulated time."""

    clock_change: ClockChange
    delta: Duration


class Clock:
    """A clock of the system: wall time or steady time."""

    def __init__(self, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        self._clock_type = clock_type

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Clock:
        """Make a `ROSClock` where ROS time is asked for."""
        wanted = ROSClock if clock_type is ClockType.ROS_TIME and cls is Clock else cls
        return super().__new__(wanted)

    @property
    def clock_type(self) -> ClockType:
        """Which clock it is."""
        return self._clock_type

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""
        steady = self._clock_type is ClockType.STEADY_TIME
        return time.monotonic_ns() if steady else time.time_ns()

    def now(self) -> Time:
        """Return the time."""
        return Time(nanoseconds=self.now_ns(), clock_type=self._clock_type)

    def sleep_until_ns(self, target_ns: int, is_over: Callable[[], bool]) -> bool:
        """Sleep until a time; False when `is_over` says so first."""
        while not is_over():
            left_ns = target_ns - self.now_ns()
            if left_ns <= 0:
                return True
            time.sleep(min(left_ns, _SLICE_NS) / 1e9)
        return False

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time; False when the context was shut down first.

        Raises:
            ValueError: the time is of another clock.
            NotInitializedException: `rclpy.init` has not been called.
        """
        context = context or get_default_context()
        if not context.ok():
            raise NotInitializedException
        if until.clock_type != self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        return self.sleep_until_ns(until.nanoseconds, lambda: not context.ok())

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Sleep for a while; False when the context was shut down first."""
        return self.sleep_until(self.now() + rel_time, context)

    def __repr__(self) -> str:
        return f"Clock(clock_type={self._clock_type.name})"


class ROSClock(Clock):
    """A node's clock: wall time, or simulated time while ``use_sim_time`` is true."""

    def __init__(self, *, clock_type: ClockType = ClockType.ROS_TIME) -> None:
        super().__init__(clock_type=clock_type)
        self._source: GraphClock | None = None

    def __new__(cls, *, clock_type: ClockType = ClockType.ROS_TIME) -> ROSClock:
        """Make one."""
        return object.__new__(cls)

    @property
    def ros_time_is_active(self) -> bool:
        """True while the clock follows ``/clock``."""
        return self._source is not None and self._source.use_sim_time

    def attach(self, source: GraphClock) -> None:
        """Follow the graph's clock."""
        self._source = source

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""
        return time.time_ns() if self._source is None else self._source.now_ns()

    def sleep_until_ns(self, target_ns: int, is_over: Callable[[], bool]) -> bool:
        """Sleep until a time; False when `is_over` says so first, or time went back."""
        if self._source is None or not self._source.use_sim_time:
            return super().sleep_until_ns(target_ns, is_over)
        try:
            return self._source.sleep_until(target_ns) and not is_over()
        except TimeJumpError:
            return False

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], Any] | None = None,
        post_callback: Callable[[TimeJump], Any] | None = None,
    ) -> None:
        """Call back when simulated time jumps backwards, as far as `threshold` wants.

        Raises:
            ValueError: there is nothing to call.
        """
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        least = threshold.min_backward
        if threshold.min_forward is not None:
            warn_once("create_jump_callback: jumps of time forward are not told, only backwards")
        elif least is None:
            warn_once("create_jump_callback: of a clock's changes only jumps backwards are told")

        def on_jump(delta_ns: int) -> None:
            if least is None or delta_ns > least.nanoseconds:
                return
            if pre_callback is not None:
                pre_callback()
            if post_callback is not None:
                change = ClockChange.ROS_TIME_NO_CHANGE
                post_callback(TimeJump(change, Duration(nanoseconds=delta_ns)))

        if self._source is not None:
            self._source.on_jump(on_jump)
