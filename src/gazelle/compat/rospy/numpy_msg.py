"""Message classes whose number arrays come out as numpy arrays (rospy.numpy_msg)."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from gazelle.interfaces import Ros1Message

__all__ = ["numpy_msg"]

_M = TypeVar("_M", bound=Ros1Message)
_NUMBERS = {
    "float32": np.float32,
    "float64": np.float64,
    "int8": np.int8,
    "int16": np.int16,
    "int32": np.int32,
    "int64": np.int64,
    "uint8": np.uint8,
    "uint16": np.uint16,
    "uint32": np.uint32,
    "uint64": np.uint64,
}


def numpy_msg(msg_type: type[_M]) -> type[_M]:
    """Return a subclass whose number arrays are numpy arrays when read; one for each class."""
    # It is kept at its class: those of a bag's own types go with the bag.
    made: type[_M] | None = vars(msg_type).get("_numpy_class")
    if made is None:
        namespace = {"__slots__": (), "__getattribute__": _get}
        made = type(f"Numpy_{msg_type._type.replace('/', '__')}", (msg_type,), namespace)
        msg_type._numpy_class = made  # type: ignore[attr-defined]
    return made


def _get(self: Ros1Message, name: str) -> object:
    value = object.__getattribute__(self, name)
    if name.startswith("_") or not isinstance(value, list | tuple | bytes):
        return value
    cls: Any = type(self).__mro__[1]
    kinds = dict(zip(cls.__slots__, cls._slot_types, strict=True))
    base, bracket, _ = kinds.get(name, "").partition("[")
    if not bracket or base not in _NUMBERS:
        return value
    if isinstance(value, bytes):
        return np.frombuffer(value, _NUMBERS[base])
    return np.asarray(value, _NUMBERS[base])
