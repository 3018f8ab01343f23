"""The bytes of a replay: a JSON head and, behind it, arrays of whole numbers in few bytes.

An array is written column by column, each number as its difference from the one before (or as the
difference of differences), zigzag, in groups of seven bits. What moves evenly becomes zeros, of
which deflate makes next to nothing. ``studio/src/replay/unpacking.ts`` reads it.
"""

from __future__ import annotations

import base64
import json
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Pack", "deflated_text", "packed_integers"]

_GROUP_BITS = 7
_MOST_GROUPS = 8
_LEVEL = 9

Reference = list[int]
"""Where an array is: offset and length in bytes, rows, columns, order of differences."""


class Pack:
    """Collects arrays; a head in JSON refers to them."""

    def __init__(self) -> None:
        """Hold nothing."""
        self._parts: list[bytes] = []
        self._size = 0

    def integers(self, values: NDArray[Any], order: int = 1) -> Reference:
        """Keep whole numbers, (N,) or (N, K), each below 2⁴⁸; return where they are.

        Args:
            values: whole numbers of any type.
            order: of the differences, 1 or 2.
        """
        table = np.asarray(values, np.int64)
        table = table if table.ndim > 1 else table.reshape(-1, 1)
        place = self.raw(packed_integers(table, order))
        return [*place, *table.shape, order]

    def raw(self, data: bytes) -> Reference:
        """Keep bytes as they are; return where they are."""
        place = [self._size, len(data)]
        self._parts.append(data)
        self._size += len(data)
        return place

    def bytes(self, head: dict[str, Any]) -> bytes:
        """Return head and arrays in one."""
        text = json.dumps(head, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        encoded = text.encode("utf-8", "replace")
        return struct.pack("<I", len(encoded)) + encoded + b"".join(self._parts)


def packed_integers(table: NDArray[np.int64], order: int) -> bytes:
    """Return the bytes of a table (N, K), column by column."""
    differences = table.T.copy()
    for _ in range(order):
        differences[:, 1:] = differences[:, 1:] - differences[:, :-1]
    signed = differences.reshape(-1)
    rest = ((signed << 1) ^ (signed >> 63)).astype(np.uint64)
    groups = np.zeros((len(rest), _MOST_GROUPS), np.uint8)
    used = np.ones(len(rest), np.int64)
    for place in range(_MOST_GROUPS):
        groups[:, place] = (rest & np.uint64(0x7F)).astype(np.uint8)
        rest = rest >> np.uint64(_GROUP_BITS)
        used += rest != 0
    places = np.arange(_MOST_GROUPS)
    groups[places < used[:, None] - 1] |= 0x80
    return groups[places < used[:, None]].tobytes()


def deflated_text(data: bytes) -> str:
    """Return bytes as deflate (zlib) in base64, the letters of which mean nothing in HTML."""
    return base64.b64encode(zlib.compress(data, _LEVEL)).decode("ascii")
