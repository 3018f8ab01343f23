"""How a class's attributes lie in the bytes: one tree per class and wire.

A class of either generation can be written in the layout of either, so a ROS 1 program's
`LaserScan` becomes the same CDR bytes as a ROS 2 program's.
"""

from __future__ import annotations

import enum
from typing import Any, NamedTuple

from gazelle.errors import InterfaceError
from gazelle.interfaces.definition import (
    FORMATS,
    Array,
    Definition,
    Field,
    RosVersion,
    attribute_name,
)
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.ros1_time import Duration, Time
from gazelle.interfaces.type_names import wire_definition, wire_field

__all__ = ["Layout", "Slot", "Wire", "bind"]

_TIME_NAMES = {
    "time": "builtin_interfaces/msg/Time",
    "duration": "builtin_interfaces/msg/Duration",
}


class Wire(enum.Enum):
    """Which bytes: CDR (ROS 2's layout) or ROS 1's own serialisation."""

    CDR = "cdr"
    ROS1 = "ros1"


_TIME_LETTERS = {
    (Wire.CDR, True): ("i", "I"),
    (Wire.CDR, False): ("i", "I"),
    (Wire.ROS1, True): ("I", "I"),
    (Wire.ROS1, False): ("i", "i"),
}


class Slot(NamedTuple):
    """One field of the bytes.

    Attributes:
        attribute: name in the object; None when the class has no such field.
        default: what is written when the class has no such field.
        letter: `struct` letter; empty of strings and messages.
        base: the wire's base type.
        array: how often.
        size: length of a fixed array or bound of a sequence.
        string_bound: bound of a string.
        child: the layout of a message.
        as_bytes: whether the object holds a sequence of bytes as `bytes` (ROS 1).
    """

    attribute: str | None
    default: Any
    letter: str
    base: str
    array: Array
    size: int
    string_bound: int
    child: Layout | None
    as_bytes: bool


class Layout(NamedTuple):
    """A class and the order of its attributes in the bytes.

    Attributes:
        name: full type name, for messages of errors.
        cls: the class.
        ros_version: whose form the class has.
        slots: in the order of the bytes.
        missing: attributes that the bytes do not hold.
    """

    name: str
    cls: type[Any]
    ros_version: RosVersion
    slots: tuple[Slot, ...]
    missing: tuple[str, ...]


def bind(types: Types, name: str, ros_version: RosVersion, wire: Wire) -> Layout:
    """Return the layout of a class in the bytes of a wire.

    Args:
        types: where definitions and classes come from.
        name: full type name.
        ros_version: form of the class.
        wire: which bytes.

    Raises:
        NotFoundError: nothing defines the type.
        InterfaceError: the two definitions give one field two kinds of values.
    """
    # Messages hold the same few others, which writer and reader of each need.
    key = ("layout", name, ros_version, wire)
    return types.remembered(key, lambda: _bound(types, name, ros_version, wire))


def _bound(types: Types, name: str, ros_version: RosVersion, wire: Wire) -> Layout:
    own = types.definition(name, ros_version)
    target = _wire_definition(types, name, ros_version, wire)
    own_fields = {item.name: item for item in own.fields}
    used, slots = set(), []
    for item in target.fields:
        mine = wire_field(target, item, own_fields)
        if mine is not None:
            _check_kinds(name, mine, item)
            used.add(mine.name)
        slots.append(_slot(types, name, item, mine, ros_version, wire))
    missing = tuple(attribute_name(key) for key in own_fields if key not in used)
    return Layout(name, types.class_of(name, ros_version), ros_version, tuple(slots), missing)


def _wire_definition(types: Types, name: str, ros_version: RosVersion, wire: Wire) -> Definition:
    if wire is Wire.ROS1:
        return types.definition(name, RosVersion.ROS1)
    if ros_version is RosVersion.ROS1:
        return wire_definition(types, name)
    return types.definition(name, RosVersion.ROS2)


def _slot(
    types: Types, name: str, item: Field, mine: Field | None, ros_version: RosVersion, wire: Wire
) -> Slot:
    kind = item.type
    base = _TIME_NAMES.get(kind.base, kind.base)
    wire_version = RosVersion.ROS1 if wire is Wire.ROS1 else RosVersion.ROS2
    child_version = ros_version if mine is not None else wire_version
    child = None
    if base in _TIME_NAMES.values():
        child = _time_layout(types, base, child_version, wire)
    elif "/" in base:
        child = bind(types, base, child_version, wire)
    byte_like = mine is not None and ros_version is RosVersion.ROS1
    letter = FORMATS.get(base if mine is None else mine.type.base, "")
    if byte_like and mine is not None and mine.type.base == "byte":
        letter = "b"  # ROS 1's byte is an int8
    return Slot(
        attribute=attribute_name(mine.name) if mine is not None else None,
        default=None if mine is not None else _wire_default(types, name, item, wire_version),
        letter=letter,
        base=base,
        array=kind.array,
        size=kind.size,
        string_bound=kind.string_bound,
        child=child,
        as_bytes=byte_like and mine is not None and mine.type.base in ("uint8", "char"),
    )


def _wire_default(types: Types, name: str, item: Field, ros_version: RosVersion) -> Any:
    """Return the default of a field that the class lacks, from the other form's class."""
    return getattr(types.class_of(name, ros_version)(), attribute_name(item.name))


def _time_layout(types: Types, base: str, ros_version: RosVersion, wire: Wire) -> Layout:
    is_time = base.endswith("Time")
    letters = _TIME_LETTERS[wire, is_time]
    if ros_version is RosVersion.ROS1:
        cls: type[Any] = Time if is_time else Duration
        names = ("secs", "nsecs")
    else:
        cls, names = types.class_of(base, ros_version), ("sec", "nanosec")
    slots = tuple(
        Slot(name, None, letter, "int32", Array.ONE, 0, 0, None, False)
        for name, letter in zip(names, letters, strict=True)
    )
    return Layout(base, cls, ros_version, slots, ())


def _check_kinds(name: str, mine: Field, theirs: Field) -> None:
    if mine.type.array is not theirs.type.array or _kind(mine) != _kind(theirs):
        raise InterfaceError(
            f"'{name}': field '{mine.name}' is {mine.type.text(RosVersion.ROS1)} in one ROS and "
            f"{theirs.type.text(RosVersion.ROS1)} in the other; they cannot be converted"
        )


def _kind(item: Field) -> str:
    base = _TIME_NAMES.get(item.type.base, item.type.base)
    if base in ("string", "wstring"):
        return "string"
    letter = FORMATS.get(base, base)
    return "B" if letter == "b" else letter
