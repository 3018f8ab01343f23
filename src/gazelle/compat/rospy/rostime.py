"""Time and Duration on the node's clock (rospy.rostime)."""

from __future__ import annotations

import time as wall_time

from gazelle.compat.rospy.exceptions import (
    ROSInitException,
)
from gazelle.compat.rospy.state import STATE
from gazelle.interfaces import Duration as _Duration
from gazelle.interfaces import Time as _Time

__all__ = [
    "Duration",
    "Time",
    "get_rostime",
    "get_time",
    "is_rostime_initialized",
    "is_wallclock",
    "wallsleep",
]


class Duration(_Duration):
    """A length of time; `rospy.Duration(1.5)` is one and a half seconds."""

    __slots__ = ()


class Time(_Time):
    """A point in time; `rospy.Time.now()` is the node's clock."""

    __slots__ = ()

    @staticmethod
    def now() -> Time:
        """Return the time now.

        Raises:
            ROSInitException: `init_node` has not been called.
        """
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> Time:
        """Return the time of so many seconds (the old name of `from_sec`)."""
        return cls.from_sec(float_secs)


def get_rostime() -> Time:
    """Return the time now: simulated when ``/use_sim_time`` is true.

    Raises:
        ROSInitException: `init_node` has not been called.
    """
    if STATE.node is None:
        raise ROSInitException("time is not initialized. Have you called init_node()?")
    return Time(nsecs=STATE.node.clock.now_ns())


def get_time() -> float:
    """Return the time now in seconds."""
    return get_rostime().to_sec()


def is_rostime_initialized() -> bool:
    """Return whether there is a clock to ask."""
    return STATE.node is not None


def is_wallclock() -> bool:
    """Return whether the clock is that of the wall."""
    return STATE.node is None or not STATE.node.clock.use_sim_time


def wallsleep(duration: float) -> None:
    """Sleep in real time."""
    if duration > 0:
        wall_time.sleep(duration)
