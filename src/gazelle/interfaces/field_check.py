"""Which value of a message does not fit its field; asked only after writing has failed."""

from __future__ import annotations

import math
import numbers
from typing import Any

from gazelle.errors import InterfaceError
from gazelle.interfaces.codec_runtime import is_array
from gazelle.interfaces.definition import FORMATS, Array, Field, FieldType, attribute_name
from gazelle.interfaces.message_base import MessageBase

__all__ = ["check_fields", "find_problem"]

_BITS = {"b": 8, "B": 8, "h": 16, "H": 16, "i": 32, "I": 32, "q": 64, "Q": 64}
_MAX_FLOAT32 = (2 - 2**-23) * 2.0**127
_PARTS = {"time": ("secs", "nsecs"), "duration": ("secs", "nsecs")}


def check_fields(msg: MessageBase, *, cause: Exception | None = None) -> None:
    """Raise when a value of a message does not fit its field.

    Args:
        msg: the message.
        cause: raised as text when no value is at fault.

    Raises:
        InterfaceError: names the field, its type and the value.
    """
    found = find_problem(msg)
    if found or cause is not None:
        raise InterfaceError(found or str(cause))


def find_problem(msg: MessageBase) -> str | None:
    """Return what is wrong with the first field that is wrong, None when all are right."""
    found = _message_problem(msg, "")
    return None if found is None else f"{msg.TYPE_NAME}: {found}"


def _message_problem(msg: Any, prefix: str) -> str | None:
    for item in msg.FIELDS:
        name = attribute_name(item.name)
        if not hasattr(msg, name):
            return f"field '{prefix}{name}' was never set"
        found = _field_problem(item, getattr(msg, name), prefix + name)
        if found is not None:
            return found
    return None


def _field_problem(item: Field, value: Any, name: str) -> str | None:
    kind = item.type
    if kind.array is Array.ONE:
        return _value_problem(kind, value, name)
    if is_array(value) and value.dtype.kind in "biuf":
        items: Any = value.ravel().tolist()
    elif isinstance(value, bytes | bytearray) and kind.base in ("uint8", "char", "byte", "int8"):
        items = ()
    elif isinstance(value, str) or not hasattr(value, "__iter__"):
        return f"field '{name}' must be a sequence of {kind.base}, is {_shown(value)}"
    else:
        items = list(value)
    if kind.array is Array.FIXED and len(value) != kind.size:
        return f"field '{name}' has {kind.size} items, got {len(value)}"
    for index, one in enumerate(items):
        found = _value_problem(kind, one, f"{name}[{index}]")
        if found is not None:
            return found
    return None


def _value_problem(kind: FieldType, value: Any, name: str) -> str | None:
    if kind.base in _PARTS:
        return _time_problem(kind.base, value, name)
    if kind.is_message:
        if isinstance(value, MessageBase):
            if kind.base != value.TYPE_NAME:
                return f"field '{name}' must be a {kind.base}, is a {value.TYPE_NAME}"
            return _message_problem(value, f"{name}.")
        return f"field '{name}' must be a {kind.base}, is {_shown(value)}"
    if kind.is_string:
        return None if isinstance(value, str) else _wrong(name, "a string (str)", value)
    return _number_problem(FORMATS[kind.base], kind.base, value, name)


def _number_problem(letter: str, base: str, value: Any, name: str) -> str | None:
    if letter == "?":
        return None
    if letter in "fd":
        if not isinstance(value, numbers.Real):
            return _wrong(name, f"a number ({base})", value)
        if letter == "f" and abs(float(value)) > _MAX_FLOAT32:
            finite = math.isfinite(float(value))
            return f"field '{name}' is {value!r}, too large for {base}" if finite else None
        return None
    if base == "byte" and isinstance(value, bytes) and len(value) == 1:
        return None
    if not isinstance(value, numbers.Integral):
        return _wrong(name, f"a whole number ({base})", value)
    bits = _BITS[letter]
    low, high = (0, 2**bits - 1) if letter.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    if not low <= int(value) <= high:
        return f"field '{name}' is {value}, outside of {base}'s range {low}…{high}"
    return None


def _time_problem(base: str, value: Any, name: str) -> str | None:
    for part in _PARTS[base]:
        if not hasattr(value, part):
            return _wrong(name, f"a rospy.{base.capitalize()}", value)
        found = _number_problem("i", "int32", getattr(value, part), f"{name}.{part}")
        if found is not None:
            return found
    return None


def _wrong(name: str, wanted: str, value: Any) -> str:
    return f"field '{name}' must be {wanted}, is {_shown(value)}"


def _shown(value: Any) -> str:
    text = repr(value)
    return f"{type(value).__name__} {text if len(text) <= 60 else text[:57] + '…'}"
