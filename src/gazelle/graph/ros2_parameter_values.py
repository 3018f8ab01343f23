"""ROS 2 parameter values: Python on one side, ``rcl_interfaces/ParameterValue`` on the other."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from typing import Any

from gazelle.errors import GraphError
from gazelle.graph import type_support

__all__ = ["ParameterType", "parameter_type", "value_from_message", "value_message"]


class ParameterType(enum.IntEnum):
    """``rcl_interfaces/msg/ParameterType``."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @property
    def word(self) -> str:
        """As ``ros2 param`` prints it."""
        return self.name.lower().replace("_", " ")

    @classmethod
    def from_parameter_value(cls, value: Any) -> ParameterType:
        """Return the kind of a Python value; rclpy's name of `parameter_type`."""
        return parameter_type(value)

    def check(self, value: Any) -> bool:
        """Tell whether a value is of this kind; an empty list is of every kind of list."""
        if value == [] and self >= ParameterType.BYTE_ARRAY:
            return True
        return parameter_type(value) is self


_FIELDS = {
    ParameterType.BOOL: "bool_value",
    ParameterType.INTEGER: "integer_value",
    ParameterType.DOUBLE: "double_value",
    ParameterType.STRING: "string_value",
    ParameterType.BYTE_ARRAY: "byte_array_value",
    ParameterType.BOOL_ARRAY: "bool_array_value",
    ParameterType.INTEGER_ARRAY: "integer_array_value",
    ParameterType.DOUBLE_ARRAY: "double_array_value",
    ParameterType.STRING_ARRAY: "string_array_value",
}
_NO_ARRAYS: dict[str, tuple[()]] = {
    _FIELDS[kind]: () for kind in ParameterType if kind >= ParameterType.BYTE_ARRAY
}
_ARRAYS = {
    bool: ParameterType.BOOL_ARRAY,
    int: ParameterType.INTEGER_ARRAY,
    float: ParameterType.DOUBLE_ARRAY,
    str: ParameterType.STRING_ARRAY,
}


def parameter_type(value: Any) -> ParameterType:
    """Return the ROS 2 type of a Python value; an empty list is one of texts, as in rclpy.

    Raises:
        GraphError: ROS 2 has no such parameters.
    """
    if value is None:
        return ParameterType.NOT_SET
    if isinstance(value, bool):
        return ParameterType.BOOL
    if isinstance(value, int):
        return ParameterType.INTEGER
    if isinstance(value, float):
        return ParameterType.DOUBLE
    if isinstance(value, str):
        return ParameterType.STRING
    if isinstance(value, bytes | bytearray):
        return ParameterType.BYTE_ARRAY
    if isinstance(value, Sequence):
        return _array_type(value)
    raise GraphError(f"a ROS 2 parameter cannot be a {type(value).__name__}")


def _array_type(values: Sequence[Any]) -> ParameterType:
    kinds = {type(item) for item in values}
    if kinds == {int, float}:
        kinds = {float}
    if not kinds:
        return ParameterType.STRING_ARRAY
    if len(kinds) == 1 and (found := _ARRAYS.get(kinds.pop())) is not None:
        return found
    raise GraphError("a ROS 2 parameter's list has items of one type: bool, int, float or str")


def value_message(value: Any, *, for_writing: bool = False) -> Any:
    """Return ``rcl_interfaces/msg/ParameterValue`` for a Python value.

    Args:
        value: None where the parameter is not set.
        for_writing: nobody looks at the arrays it does not hold, so they are no numpy arrays: a
            node that tells of its parameters at its start would import numpy for them.

    Raises:
        GraphError: ROS 2 has no such parameters.
    """
    kind = parameter_type(value)
    message = type_support.resolve_type("rcl_interfaces/msg/ParameterValue")(
        type=int(kind), **(_NO_ARRAYS if for_writing else {})
    )
    if kind is not ParameterType.NOT_SET:
        items = list(value) if kind >= ParameterType.BYTE_ARRAY else value
        if kind is ParameterType.DOUBLE_ARRAY:
            items = [float(item) for item in items]
        setattr(message, _FIELDS[kind], items)
    return message


def value_from_message(message: Any) -> Any:
    """Return the Python value of a ``ParameterValue``; None when it is not set.

    Raises:
        GraphError: its type is none of ROS 2's.
    """
    if not 0 <= message.type < len(ParameterType):
        raise GraphError(f"a parameter's type is {message.type}; ROS 2 has 0 to 9")
    kind = ParameterType(message.type)
    if kind is ParameterType.NOT_SET:
        return None
    value = getattr(message, _FIELDS[kind])
    if kind is ParameterType.BYTE_ARRAY:
        return bytes(value)
    if kind < ParameterType.BYTE_ARRAY:
        return value
    return value.tolist() if hasattr(value, "tolist") else list(value)
