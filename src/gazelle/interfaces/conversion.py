"""ROS 1 types that become another ROS 2 type by more than names.

``/rosout`` is `rcl_interfaces/msg/Log` on the wire for both generations: the header's stamp is
the stamp, levels 1, 2, 4, 8, 16 are 10, 20, 30, 40, 50, and ROS 1's list of topics stays behind.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

__all__ = ["CONVERTED", "Conversion"]

_LEVELS = {1: 10, 2: 20, 4: 30, 8: 40, 16: 50}
_LEVELS_BACK = {ros2: ros1 for ros1, ros2 in _LEVELS.items()}
_WORDS = ("name", "msg", "file", "function", "line")


class Conversion(NamedTuple):
    """How a ROS 1 object and the object that travels become each other.

    Attributes:
        wire_name: full name of what travels.
        to_wire: from a ROS 1 object and the class that travels.
        from_wire: from what travels and the class of ROS 1.
    """

    wire_name: str
    to_wire: Callable[[Any, Any], Any]
    from_wire: Callable[[Any, Any], Any]


def _log_to_wire(log: Any, wire_class: Any) -> Any:
    wire = wire_class(**{word: getattr(log, word) for word in _WORDS})
    wire.stamp.sec, wire.stamp.nanosec = log.header.stamp.secs, log.header.stamp.nsecs
    wire.level = _LEVELS.get(log.level, log.level)
    return wire


def _log_from_wire(wire: Any, log_class: Any) -> Any:
    log = log_class(**{word: getattr(wire, word) for word in _WORDS})
    log.header.stamp.secs, log.header.stamp.nsecs = wire.stamp.sec, wire.stamp.nanosec
    log.level = _LEVELS_BACK.get(wire.level, wire.level)
    return log


CONVERTED = {
    "rosgraph_msgs/msg/Log": Conversion("rcl_interfaces/msg/Log", _log_to_wire, _log_from_wire)
}
"""By full ROS 1 name."""
