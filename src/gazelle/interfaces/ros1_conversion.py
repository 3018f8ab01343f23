"""A definition of one ROS generation in the words of the other.

``/rosout`` is `rcl_interfaces/msg/Log` on the wire for both generations: the header's stamp is
the stamp, levels 1, 2, 4, 8, 16 are 10, 20, 30, 40, 50, and ROS 1's list of topics stays behind.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.interfaces.definition import (
    Array,
    Constant,
    Definition,
    Field,
    FieldType,
    RosVersion,
)

__all__ = ["CONVERTED", "Conversion", "as_ros_version", "definition_text"]


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

_TO_ROS2 = {
    "time": "builtin_interfaces/msg/Time",
    "duration": "builtin_interfaces/msg/Duration",
    "byte": "int8",
    "char": "uint8",
}

_TO_ROS1 = {
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
    "wstring": "string",
}


def as_ros_version(definition: Definition, ros_version: RosVersion) -> Definition:
    """Return the definition by the rules of a generation; the same object when it has them.

    Field names stay. ROS 1 ``byte`` is signed and ``char`` unsigned; ROS 1 has no bounds, no
    defaults and no wide strings.
    """
    if definition.ros_version is ros_version:
        return definition
    table = _TO_ROS2 if ros_version is RosVersion.ROS2 else _TO_ROS1
    fields = tuple(_field(item, table, ros_version) for item in definition.fields)
    constants = tuple(
        item._replace(type=table.get(item.type, item.type)) for item in definition.constants
    )
    text = definition_text(constants, fields, ros_version)
    return Definition(definition.name, ros_version, constants, fields, text, native=False)


def definition_text(
    constants: tuple[Constant, ...], fields: tuple[Field, ...], ros_version: RosVersion
) -> str:
    """Return the lines that define these constants and fields, constants first."""
    lines = [f"{item.type} {item.name}={item.text}" for item in constants]
    lines += [f"{item.type.text(ros_version)} {item.name}" for item in fields]
    return "\n".join(lines)


def _field(item: Field, table: dict[str, str], ros_version: RosVersion) -> Field:
    kind = item.type
    base = table.get(kind.base, kind.base)
    if ros_version is RosVersion.ROS2:
        return Field(item.name, kind._replace(base=base), item.default)
    size = kind.size if kind.array is Array.FIXED else 0
    return Field(item.name, FieldType(base, kind.array, size))
