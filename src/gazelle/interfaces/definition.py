"""What a message definition says: constants and fields, whatever text it came from."""

from __future__ import annotations

import enum
import keyword
from typing import NamedTuple

__all__ = [
    "FORMATS",
    "NUMPY_NAMES",
    "Array",
    "Constant",
    "Definition",
    "Field",
    "FieldType",
    "RosVersion",
    "Scalar",
    "attribute_name",
]

Scalar = bool | int | float | str


class RosVersion(enum.IntEnum):
    """Which ROS a definition was written for."""

    ROS1 = 1
    ROS2 = 2


class Array(enum.Enum):
    """How often a field's value is repeated."""

    ONE = "one"
    FIXED = "fixed"
    SEQUENCE = "sequence"


FORMATS: dict[str, str] = {
    "bool": "?",
    "byte": "B",
    "char": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
"""`struct` letter of every numeric primitive (of ROS 2; ROS 1 `byte` is an `int8`)."""

NUMPY_NAMES: dict[str, str] = {
    "?": "?",
    "b": "i1",
    "B": "u1",
    "h": "i2",
    "H": "u2",
    "i": "i4",
    "I": "u4",
    "q": "i8",
    "Q": "u8",
    "f": "f4",
    "d": "f8",
}
"""numpy's name of every `struct` letter, without the byte order."""


_IDL_NAMES = {
    "bool": "boolean",
    "byte": "octet",
    "char": "uint8",
    "float32": "float",
    "float64": "double",
}


class FieldType(NamedTuple):
    """The type of a field.

    Attributes:
        base: a primitive (``float64``, ``string``, ``wstring``, in ROS 1 also ``time`` and
            ``duration``) or a full message name such as ``geometry_msgs/msg/Point``.
        array: one value, an array of fixed length or a sequence.
        size: length of a fixed array, upper bound of a sequence; 0 is unbounded.
        string_bound: upper bound of a string's length; 0 is unbounded.
    """

    base: str
    array: Array = Array.ONE
    size: int = 0
    string_bound: int = 0

    @property
    def is_message(self) -> bool:
        """Whether the base is a message."""
        return "/" in self.base

    @property
    def is_string(self) -> bool:
        """Whether the base is a string, narrow or wide."""
        return self.base in ("string", "wstring")

    @property
    def idl(self) -> str:
        """The type in the words of IDL, as ``get_fields_and_field_types`` of ROS 2 has it."""
        base = _IDL_NAMES.get(self.base, self.base)
        if self.is_message:
            package, _, name = base.split("/")
            base = f"{package}/{name}"
        elif self.string_bound:
            base = f"{base}<{self.string_bound}>"
        if self.array is Array.ONE:
            return base
        if self.array is Array.FIXED:
            return f"{base}[{self.size}]"
        return f"sequence<{base}, {self.size}>" if self.size else f"sequence<{base}>"

    def text(self, ros_version: RosVersion) -> str:
        """Return the type as that generation writes it."""
        base = self.base
        if self.is_message:
            package, _, name = base.split("/")
            base = f"{package}/{name}"
        if ros_version is RosVersion.ROS1:
            return base + {Array.ONE: "", Array.FIXED: f"[{self.size}]"}.get(self.array, "[]")
        bound = f"<={self.string_bound}" if self.string_bound else ""
        if self.array is Array.ONE:
            return base + bound
        if self.array is Array.FIXED:
            return f"{base}{bound}[{self.size}]"
        return f"{base}{bound}[<={self.size}]" if self.size else f"{base}{bound}[]"


class Field(NamedTuple):
    """One field: its name, type and default (None: the type's own default)."""

    name: str
    type: FieldType
    default: Scalar | tuple[Scalar, ...] | None = None


class Constant(NamedTuple):
    """One constant; `text` is the value as the definition writes it (MD5 sums need it)."""

    name: str
    type: str
    value: Scalar
    text: str


class Definition(NamedTuple):
    """A message, or one part of a service or action.

    Attributes:
        name: full name, such as ``std_msgs/msg/Header`` or ``std_srvs/srv/Empty_Request``.
        ros_version: whose rules the types follow.
        constants: in the order written.
        fields: in the order written.
        text: the definition's text; of a translated definition, a text that would define it.
        native: whether the text was written for `ros_version`, not translated.
    """

    name: str
    ros_version: RosVersion
    constants: tuple[Constant, ...]
    fields: tuple[Field, ...]
    text: str
    native: bool = True

    @property
    def package(self) -> str:
        """The package part of the name."""
        return self.name.split("/", 1)[0]


def attribute_name(field_name: str) -> str:
    """Return the Python attribute of a field: Python's own words get an underscore."""
    return field_name + "_" if keyword.iskeyword(field_name) else field_name
