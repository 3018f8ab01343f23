"""Builds ROS messages for controllers; the interfaces are imported on first use."""

from __future__ import annotations

from functools import cache
from typing import Any

from gazelle.interfaces.stamps import stamp_message

__all__ = ["header", "message_class", "stamped"]


@cache
def message_class(name: str) -> Any:
    """Return the class of a type such as ``sensor_msgs/JointState``."""
    from gazelle.interfaces import message_type

    return message_type(name)


def header(time_ns: int, frame_id: str = "") -> Any:
    """Return a ``std_msgs/Header``."""
    return message_class("std_msgs/Header")(stamp=stamp_message(time_ns), frame_id=frame_id)


def stamped(name: str, time_ns: int, frame_id: str = "") -> Any:
    """Return a message of a type with a header."""
    return message_class(name)(header=header(time_ns, frame_id))
