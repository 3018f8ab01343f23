"""Times in messages of either generation as nanoseconds."""

from __future__ import annotations

from typing import Any

__all__ = ["set_stamp", "stamp_ns"]

_NANO = 1_000_000_000


def stamp_ns(stamp: Any) -> int:
    """Return a time of ROS 1 (secs, nsecs) or ROS 2 (sec, nanosec) in nanoseconds."""
    if hasattr(stamp, "nanosec"):
        return int(stamp.sec) * _NANO + int(stamp.nanosec)
    return int(stamp.secs) * _NANO + int(stamp.nsecs)


def set_stamp(stamp: Any, time_ns: int) -> None:
    """Write nanoseconds into a time of ROS 1 or ROS 2."""
    seconds, rest = divmod(time_ns, _NANO)
    if hasattr(stamp, "nanosec"):
        stamp.sec, stamp.nanosec = seconds, rest
    else:
        stamp.secs, stamp.nsecs = seconds, rest
