"""Times, durations and headers in messages ↔ nanoseconds.

ROS 1 has ``secs`` and ``nsecs``, ROS 2 ``sec`` and ``nanosec``; nanoseconds are in [0, 1e9) in
both, so that a negative duration has negative seconds.
"""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type

__all__ = [
    "NS_PER_S",
    "header",
    "ns_of",
    "seconds_of",
    "set_header",
    "set_stamp",
    "stamp_message",
    "stamped",
]

NS_PER_S = 1_000_000_000


def ns_of(stamp: Any) -> int:
    """Return a time or duration of a message in nanoseconds."""
    if hasattr(stamp, "nanosec"):
        return int(stamp.sec) * NS_PER_S + int(stamp.nanosec)
    return int(stamp.secs) * NS_PER_S + int(stamp.nsecs)


def seconds_of(stamp: Any) -> float:
    """Return a time or duration of a message in seconds, rounded as floats are."""
    if hasattr(stamp, "nanosec"):
        return float(stamp.sec + stamp.nanosec / 1e9)
    return float(stamp.secs + stamp.nsecs / 1e9)


def set_stamp(stamp: Any, time_ns: int) -> None:
    """Write nanoseconds into a time or duration of a message."""
    seconds, rest = divmod(time_ns, NS_PER_S)
    if hasattr(stamp, "nanosec"):
        stamp.sec, stamp.nanosec = seconds, rest
    else:
        stamp.secs, stamp.nsecs = seconds, rest


def stamp_message(time_ns: int) -> Any:
    """Return nanoseconds as a ``builtin_interfaces/Time`` of ROS 2."""
    return message_type("builtin_interfaces/msg/Time")(*divmod(time_ns, NS_PER_S))


def header(time_ns: int, frame_id: str = "") -> Any:
    """Return a ``std_msgs/Header`` of ROS 2."""
    return message_type("std_msgs/msg/Header")(stamp=stamp_message(time_ns), frame_id=frame_id)


def stamped(name: str, time_ns: int, frame_id: str = "") -> Any:
    """Return a message of a type with a header, in the form of ROS 2."""
    return message_type(name)(header=header(time_ns, frame_id))


def set_header(message: Any, time_ns: int, frame_id: str) -> None:
    """Write time and frame into the header of a message of ROS 2."""
    message.header.frame_id = frame_id
    set_stamp(message.header.stamp, time_ns)
