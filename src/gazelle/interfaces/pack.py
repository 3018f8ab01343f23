"""What generated writers call at run time: padding tables and arrays that are not numpy's."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np

from gazelle.errors import InterfaceError
from gazelle.interfaces.definition import NUMPY_NAMES

__all__ = [
    "ENCAPSULATION_LE",
    "END_PADS",
    "PADS",
    "contiguous",
    "packer",
    "too_long",
    "wrong_length",
]

ENCAPSULATION_LE = 0x0100
"""CDR, little endian, no options: bytes 00 01 00 00 as a little-endian uint32."""

PADS = {size: tuple(bytes(-rest % size) for rest in range(size)) for size in (2, 4, 8)}
"""By remainder: zeros up to the next multiple."""

END_PADS = {size: tuple(bytes(1 + -(rest + 1) % size) for rest in range(size)) for size in PADS}
"""By remainder behind a string's letters: its end byte and the zeros up to the multiple."""


def contiguous(array: np.ndarray[Any, Any]) -> Any:
    """Return an array's bytes, without a copy where they lie in one piece."""
    return array if array.flags.c_contiguous else array.tobytes()


def packer(letter: str, label: str) -> Callable[[Any], tuple[Any, int]]:
    """Return a function from any sequence of numbers to its bytes and their count.

    Args:
        letter: `struct` letter of the numbers.
        label: type and field, for messages of errors.
    """
    kind = np.dtype("<" + NUMPY_NAMES[letter])

    def pack(values: Any) -> tuple[Any, int]:
        if isinstance(values, list | tuple):
            if letter == "B" and values and values[0].__class__ is bytes:
                return b"".join(values), len(values)
            return struct.pack(f"<{len(values)}{letter}", *values), len(values)
        if isinstance(values, bytes | bytearray | memoryview) and letter in "bB":
            return values, memoryview(values).nbytes
        if isinstance(values, str) or values is None:
            raise InterfaceError(f"{label} must be a sequence of numbers, is {values!r}")
        return _from_array(values, kind, label)

    return pack


def _from_array(values: Any, kind: np.dtype[Any], label: str) -> tuple[bytes, int]:
    array = values if isinstance(values, np.ndarray) else np.array(list(values))
    if not array.size:
        return b"", 0
    if not np.can_cast(array.dtype, kind, "same_kind") and not _fits(array, kind):
        raise InterfaceError(f"{label} is an array of {kind}, got {array.dtype}")
    return array.astype(kind).tobytes(), array.size


def _fits(array: np.ndarray[Any, Any], kind: np.dtype[Any]) -> bool:
    """Whether whole numbers of another kind are all in range."""
    if array.dtype.kind not in "iub" or kind.kind not in "iubf":
        return False
    if kind.kind in "fb":
        return True
    limits = np.iinfo(kind)
    return bool(array.min() >= limits.min and array.max() <= limits.max)


def too_long(label: str, count: int, bound: int) -> NoReturn:
    """Raise that a value is longer than its bound."""
    raise InterfaceError(f"{label} takes at most {bound} items, has {count}")


def wrong_length(label: str, count: int, size: int) -> NoReturn:
    """Raise that a fixed array has another length."""
    raise InterfaceError(f"{label} has {size} items, got {count}")
