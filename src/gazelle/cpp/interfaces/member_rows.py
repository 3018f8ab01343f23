"""The table of a message's members that the codec reads (`gazelle::Member` in C++).

A class of ROS 1 has two: its own order, which is ROS 1's wire, and the order of CDR, where a member
may be missing, renamed or added.
"""

from __future__ import annotations

import struct
from typing import Any, NamedTuple

from gazelle.cpp.interfaces.field_types import element_type, literal
from gazelle.interfaces import Definition, Field, RosVersion, TypeStore
from gazelle.interfaces.definition import Array, attribute_name
from gazelle.interfaces.wire_layout import Slot, Wire, bind

__all__ = ["MemberTables", "member_tables"]

_LOG = "rosgraph_msgs/msg/Log"
_KINDS = {
    "bool": "boolean",
    "char": "uint8",
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
}
_REPEATS = {Array.ONE: "one", Array.FIXED: "fixed", Array.SEQUENCE: "sequence"}
_LOG_ROWS = (
    '{"stamp", offsetof(Self, header) + '
    "offsetof(::std_msgs::Header_<ContainerAllocator>, stamp), Kind::time}",
    '{"level", offsetof(Self, level), Kind::log_level}',
    '{"name", offsetof(Self, name), Kind::string}',
    '{"msg", offsetof(Self, msg), Kind::string}',
    '{"file", offsetof(Self, file), Kind::string}',
    '{"function", offsetof(Self, function), Kind::string}',
    '{"line", offsetof(Self, line), Kind::uint32}',
)


class MemberTables(NamedTuple):
    """Rows in C++.

    Attributes:
        own: in the class's own order.
        cdr: in the order of CDR; empty when that is the same.
        is_cdr_own: whether both are the same.
        functions: declarations of what rows of messages that the class lacks refer to.
    """

    own: tuple[str, ...]
    cdr: tuple[str, ...]
    is_cdr_own: bool
    functions: tuple[str, ...]


def member_tables(types: TypeStore, definition: Definition) -> MemberTables:
    """Return the tables of a message.

    Args:
        types: where definitions come from.
        definition: by the rules of the generation whose class it is.
    """
    ros_version = definition.ros_version
    own = tuple(_own_row(item, ros_version) for item in definition.fields)
    if ros_version is RosVersion.ROS2:
        return MemberTables(own, (), True, ())
    if definition.name == _LOG:
        return MemberTables(own, _LOG_ROWS, False, ())
    by_attribute = {attribute_name(item.name): item for item in definition.fields}
    absent = _Absent(types)
    rows = []
    for slot in bind(types, definition.name, ros_version, Wire.CDR).slots:
        if slot.attribute is None:
            rows.append(absent.row(slot))
        else:
            mine = by_attribute[slot.attribute]
            bounded = mine.type._replace(size=slot.size, string_bound=slot.string_bound)
            kind = "wide_on_wire" if slot.base == "wstring" else ""
            rows.append(_own_row(mine._replace(type=bounded), ros_version, kind))
    cdr = tuple(rows)
    if cdr == own:
        return MemberTables(own, (), True, ())
    return MemberTables(own, cdr, False, tuple(absent.functions.values()))


def _own_row(item: Field, ros_version: RosVersion, kind: str = "") -> str:
    kind = kind or _kind(item.type.base, ros_version)
    child = sequence = "nullptr"
    if item.type.is_message:
        element = element_type(item.type, ros_version)
        child = f"&Description<{element}>::layout"
        if item.type.array is Array.SEQUENCE:
            sequence = f"&detail::SequenceOf<{element}>::table"
    values = [
        f"Repeat::{_REPEATS[item.type.array]}",
        f"{item.type.size}",
        f"{item.type.string_bound}",
        child,
        sequence,
    ]
    unset = ["Repeat::one", "0", "0", "nullptr", "nullptr"]
    while values and values[-1] == unset[len(values) - 1]:
        values.pop()
    start = f'"{item.name}", offsetof(Self, {item.name}), Kind::{kind}'
    return f"{{{', '.join([start, *values])}}}"


def _kind(base: str, ros_version: RosVersion) -> str:
    if "/" in base:
        return "message"
    if base == "byte" and ros_version is RosVersion.ROS1:
        return "int8"
    if base == "bool" and ros_version is RosVersion.ROS1:
        return "boolean"
    if base == "wstring" and ros_version is RosVersion.ROS1:
        return "string"
    return _KINDS.get(base, base)


class _Absent:
    """Rows of what CDR has and a class of ROS 1 lacks, and layouts of messages of that kind."""

    def __init__(self, types: TypeStore) -> None:
        self.functions: dict[str, str] = {}
        self._types = types

    def row(self, slot: Slot) -> str:
        """Return the row of a member that the class lacks."""
        kind = _KINDS.get(slot.base, "message" if slot.child is not None else slot.base)
        child, bits, text = "nullptr", "0", "nullptr"
        if kind == "message":
            child = f"&{self._layout(slot.base)}"
        elif slot.letter and slot.array is Array.ONE:
            bits = _bits(slot.letter, slot.default)
        elif slot.base == "string" and slot.array is Array.ONE and slot.default:
            text = literal("string", slot.default, RosVersion.ROS1)
        return (
            f'{{"", absent, Kind::{kind}, Repeat::{_REPEATS[slot.array]}, {slot.size}, '
            f"{slot.string_bound}, {child}, nullptr, {bits}, {text}}}"
        )

    def _layout(self, full: str) -> str:
        name = "absent_" + full.replace("/", "_")
        if name in self.functions:
            return name
        self.functions[name] = ""  # before those inside of it
        slots = bind(self._types, full, RosVersion.ROS2, Wire.CDR).slots
        defaults: Any = self._types.message_type(full)()
        rows = [
            self.row(slot._replace(attribute=None, default=getattr(defaults, slot.attribute or "")))
            for slot in slots
        ]
        del self.functions[name]  # those inside stand before it
        members = ", ".join(rows)
        table = f"static const Member members[] = {{{members}}}; " if rows else ""
        where = "members" if rows else "nullptr"
        self.functions[name] = (
            f"static const Layout &{name}() {{ {table}static const Layout found{{"
            f'"{full}", "", "", "", "", false, 0, {where}, {len(rows)}, {where}, {len(rows)}}}; '
            "return found; }"
        )
        return name


def _bits(letter: str, value: Any) -> str:
    packed = struct.pack("<" + letter, value).ljust(8, b"\0")
    return f"{int.from_bytes(packed, 'little')}ull"
