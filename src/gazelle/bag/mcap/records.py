"""Records of MCAP: ``<op><length><content>``; strings, maps and numbers inside."""

from __future__ import annotations

import enum
import struct
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from gazelle.bag.storage import BagError

__all__ = ["HEAD", "MAGIC", "Cursor", "Op", "Record", "pack_map", "pack_record", "pack_string"]
__all__ += ["records_in"]

MAGIC = b"\x89MCAP0\r\n"
HEAD = struct.Struct("<BQ")


class Op(enum.IntEnum):
    """What a record is."""

    HEADER = 0x01
    FOOTER = 0x02
    SCHEMA = 0x03
    CHANNEL = 0x04
    MESSAGE = 0x05
    CHUNK = 0x06
    MESSAGE_INDEX = 0x07
    CHUNK_INDEX = 0x08
    STATISTICS = 0x0B
    SUMMARY_OFFSET = 0x0E
    DATA_END = 0x0F


class Record(NamedTuple):
    """A record: what it is, and where its content lies."""

    op: int
    start: int
    size: int

    @property
    def end(self) -> int:
        """Where the next record starts."""
        return self.start + self.size


def pack_record(op: Op, *pieces: bytes) -> bytes:
    """Return a record."""
    return b"".join([HEAD.pack(op, sum(map(len, pieces))), *pieces])


def pack_string(text: str) -> bytes:
    """Return a string with its length."""
    data = text.encode()
    return struct.pack("<I", len(data)) + data


def pack_map(pairs: Mapping[str, str]) -> bytes:
    """Return a map of strings with its length in bytes."""
    data = b"".join(pack_string(key) + pack_string(value) for key, value in pairs.items())
    return struct.pack("<I", len(data)) + data


def records_in(data: bytes) -> Iterator[Record]:
    """Yield the records of a chunk.

    Raises:
        BagError: the bytes are no records.
    """
    offset = 0
    while offset < len(data):
        try:
            op, size = HEAD.unpack_from(data, offset)
        except struct.error:
            raise BagError("a chunk ends in the middle of a record") from None
        record = Record(op, offset + HEAD.size, size)
        if record.end > len(data):
            raise BagError("a chunk ends in the middle of a record")
        yield record
        offset = record.end


class Cursor:
    """Reads the content of a record from front to back."""

    def __init__(self, data: bytes) -> None:
        """Start at the front."""
        self._data = data
        self._place = 0

    def numbers(self, layout: str) -> tuple[int, ...]:
        """Return little-endian numbers by `struct` letters.

        Raises:
            BagError: the content ends before.
        """
        try:
            found = struct.unpack_from(f"<{layout}", self._data, self._place)
        except struct.error:
            raise BagError("a record is shorter than its fields") from None
        self._place += struct.calcsize(f"<{layout}")
        return found

    def block(self, letter: str = "I") -> bytes:
        """Return bytes with their length in front."""
        (size,) = self.numbers(letter)
        found = self._data[self._place : self._place + size]
        if len(found) != size:
            raise BagError("a record is shorter than its fields")
        self._place += size
        return found

    def string(self) -> str:
        """Return a string."""
        return self.block().decode("utf-8", "replace")

    def map(self) -> dict[str, str]:
        """Return a map of strings."""
        inner, found = Cursor(self.block()), {}
        while not inner.at_end:
            key = inner.string()
            found[key] = inner.string()
        return found

    @property
    def at_end(self) -> bool:
        """Whether everything is read."""
        return self._place >= len(self._data)
