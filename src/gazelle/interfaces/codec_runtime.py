"""What generated codecs call at run time: padding tables, arrays of numpy's and others.

Where nobody has imported numpy no value is an array. Programs whose messages hold no arrays of
numbers, as most small ones, start in half the time without it.
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn, TypeGuard

from gazelle.errors import InterfaceError
from gazelle.interfaces.definition import NUMPY_NAMES

if TYPE_CHECKING:
    import numpy as np

__all__ = [
    "ENCAPSULATION_LE",
    "END_PADS",
    "PADS",
    "is_array",
    "is_array_item",
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

_COPY_BELOW = 2048


def is_array(value: Any) -> TypeGuard[np.ndarray[Any, Any]]:
    """Tell whether a value is a numpy array, of whatever shape."""
    return isinstance(value, _numpy_class("ndarray"))


def is_array_item(value: Any) -> TypeGuard[np.generic]:
    """Tell whether a value is a single number of numpy's."""
    return isinstance(value, _numpy_class("generic"))


def packer(letter: str, label: str) -> Callable[[Any], tuple[Any, int]]:
    """Return a function from any sequence of numbers to its bytes and their count.

    Args:
        letter: `struct` letter of the numbers.
        label: type and field, for messages of errors.
    """
    kind: np.dtype[Any] | None = None
    array: type[np.ndarray[Any, Any]] | None = None

    def pack(values: Any) -> tuple[Any, int]:
        nonlocal kind, array
        if values.__class__ is array and values.dtype is kind:
            count = values.size
            if count < _COPY_BELOW or not values.flags.c_contiguous:
                return values.tobytes(), count
            return values, count
        if is_array(values):
            if kind is None:
                import numpy as np

                kind, array = _kind(letter), np.ndarray
                return pack(values)
            return _from_array(values, kind, label)
        if isinstance(values, list | tuple):
            if letter == "B" and values and values[0].__class__ is bytes:
                return b"".join(values), len(values)
            return struct.pack(f"<{len(values)}{letter}", *values), len(values)
        if isinstance(values, bytes | bytearray | memoryview) and letter in "bB":
            return values, memoryview(values).nbytes
        if isinstance(values, str) or values is None:
            raise InterfaceError(f"{label} must be a sequence of numbers, is {values!r}")
        import numpy as np

        return _from_array(np.array(list(values)), _kind(letter), label)

    return pack


def too_long(label: str, count: int, bound: int) -> NoReturn:
    """Raise that a value is longer than its bound."""
    raise InterfaceError(f"{label} takes at most {bound} items, has {count}")


def wrong_length(label: str, count: int, size: int) -> NoReturn:
    """Raise that a fixed array has another length."""
    raise InterfaceError(f"{label} has {size} items, got {count}")


def _numpy_class(name: str) -> Any:
    # Another thread may be importing it just now.
    return getattr(sys.modules.get("numpy"), name, ())


def _kind(letter: str) -> np.dtype[Any]:
    # Only here: numpy's import would be a third of the start of a small node.
    import numpy as np

    return np.dtype("<" + NUMPY_NAMES[letter])


def _from_array(array: np.ndarray[Any, Any], kind: np.dtype[Any], label: str) -> tuple[bytes, int]:
    import numpy as np

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
    import numpy as np

    limits = np.iinfo(kind)
    return bool(array.min() >= limits.min and array.max() <= limits.max)
