"""What a field of a definition is in C++: its type, its first value and a literal of a constant."""

from __future__ import annotations

import json
import math

from gazelle.cpp.interfaces.header_names import class_name
from gazelle.interfaces import Constant, Field, FieldType, RosVersion
from gazelle.interfaces.definition import Array, Scalar

__all__ = ["constant_lines", "element_type", "field_type", "initial_value", "literal"]

_NUMBERS = {
    "int8": "int8_t",
    "uint8": "uint8_t",
    "int16": "int16_t",
    "uint16": "uint16_t",
    "int32": "int32_t",
    "uint32": "uint32_t",
    "int64": "int64_t",
    "uint64": "uint64_t",
    "float32": "float",
    "float64": "double",
}
_ROS1 = _NUMBERS | {
    "bool": "uint8_t",
    "byte": "int8_t",
    "char": "uint8_t",
    "time": "::ros::Time",
    "duration": "::ros::Duration",
    "string": "::gazelle::ros1::String<ContainerAllocator>",
    "wstring": "::gazelle::ros1::String<ContainerAllocator>",
}
_ROS2 = _NUMBERS | {
    "bool": "bool",
    "byte": "unsigned char",
    "char": "unsigned char",
    "string": "std::string",
    "wstring": "std::u16string",
}
_WHOLE = frozenset(_NUMBERS) - {"float32", "float64"} | {"byte", "char"}
_LEAST = {"int64": -(2**63), "int32": -(2**31)}


def element_type(kind: FieldType, ros_version: RosVersion) -> str:
    """Return the C++ type of one value of a field."""
    if kind.is_message:
        return class_name(kind.base, ros_version, "ContainerAllocator")
    return (_ROS1 if ros_version is RosVersion.ROS1 else _ROS2)[kind.base]


def field_type(kind: FieldType, ros_version: RosVersion) -> str:
    """Return the C++ type of a field."""
    element = element_type(kind, ros_version)
    if kind.array is Array.ONE:
        return element
    if ros_version is RosVersion.ROS1:
        if kind.array is Array.FIXED:
            return f"boost::array<{element}, {kind.size}>"
        return f"::gazelle::ros1::Vector<{element}, ContainerAllocator>"
    if kind.array is Array.FIXED:
        return f"std::array<{element}, {kind.size}>"
    if kind.size:
        return f"rosidl_runtime_cpp::BoundedVector<{element}, {kind.size}>"
    return f"std::vector<{element}>"


def initial_value(item: Field, ros_version: RosVersion) -> str:
    """Return the braces that a member is declared with."""
    kind, default = item.type, item.default
    if default is None or ros_version is RosVersion.ROS1:
        return "{}"
    if isinstance(default, tuple):
        inner = ", ".join(literal(kind.base, value, ros_version) for value in default)
        return f"{{{{{inner}}}}}" if kind.array is Array.FIXED else f"{{{inner}}}"
    return f"{{{literal(kind.base, default, ros_version)}}}"


def literal(base: str, value: Scalar, ros_version: RosVersion) -> str:
    """Return a value of a primitive type as C++ writes it."""
    if base == "bool":
        word = "true" if value else "false"
        return word if ros_version is RosVersion.ROS2 else str(int(bool(value)))
    if base == "wstring" and ros_version is RosVersion.ROS2:
        return f"u{_quoted(str(value))}"
    if base in ("string", "wstring"):
        return _quoted(str(value))
    if base in ("float32", "float64"):
        return _real(float(value), base)
    number = int(value)
    if number == _LEAST.get(base):
        return f"({number + 1}{'ll' if base == 'int64' else ''} - 1)"
    if base == "byte" and number > 127 and ros_version is RosVersion.ROS1:
        number -= 256
    ending = "u" if base.startswith("u") else ""
    return f"{number}{ending}{'ll' if base.endswith('64') else ''}"


def constant_lines(item: Constant, ros_version: RosVersion) -> str:
    """Return the declaration of a constant inside its class.

    Whole numbers of ROS 1 are enumerators, as programs that print or compare them expect.
    """
    value = literal(item.type, item.value, ros_version)
    if ros_version is RosVersion.ROS1:
        if item.type in _WHOLE:
            return f"enum {{ {item.name} = {value} }};"
        if item.type in ("string", "wstring"):
            return f"inline static const std::string {item.name}{{{value}}};"
        return f"static constexpr {_ROS1[item.type]} {item.name} = {value};"
    if item.type in ("string", "wstring"):
        return f"inline static const {_ROS2[item.type]} {item.name}{{{value}}};"
    return f"static constexpr {_ROS2[item.type]} {item.name} = {value};"


def _quoted(text: str) -> str:
    # JSON's escapes are C++'s too but for \u of letters outside of the basic plane.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\x7f")


def _real(value: float, base: str) -> str:
    kind = "float" if base == "float32" else "double"
    if math.isnan(value):
        return f"std::numeric_limits<{kind}>::quiet_NaN()"
    if math.isinf(value):
        sign = "-" if value < 0 else ""
        return f"{sign}std::numeric_limits<{kind}>::infinity()"
    return f"{value!r}{'f' if base == 'float32' else ''}"
