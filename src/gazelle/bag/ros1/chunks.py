"""Chunks: how they are compressed, and what lies in them."""

from __future__ import annotations

import bz2
import enum
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from gazelle.bag.compression_formats import decompressed
from gazelle.bag.ros1.records import Op, read_fields, unpack_stamp
from gazelle.bag.storage import BagError, Connection, Encoding

__all__ = ["CHUNK_BYTES", "Chunk", "Compression", "Entry", "compress", "connection_of"]
__all__ += ["connections_in", "decompress", "entries_in", "message_at"]

CHUNK_BYTES = 768 * 1024
"""When a chunk is full, as in rosbag."""

Entry = tuple[int, int, int]
"""Connection, stamp in nanoseconds, offset in the chunk."""

_LENGTH = struct.Struct("<I")


class Compression(enum.StrEnum):
    """How chunks are compressed."""

    NONE = "none"
    BZ2 = "bz2"
    LZ4 = "lz4"


@dataclass(slots=True)
class Chunk:
    """One chunk of a file.

    Attributes:
        position: where its record starts.
        compression: as the file names it.
        start, size: where its bytes lie and how many they are.
        uncompressed: how many they are once decompressed.
        end: where its last index record ends.
        start_ns, end_ns: stamps of the first and last message.
        counts: messages by connection.
    """

    position: int
    compression: str
    start: int
    size: int
    uncompressed: int
    end: int = 0
    start_ns: int = 0
    end_ns: int = 0
    counts: dict[int, int] = field(default_factory=dict)


def compress(data: bytes, compression: Compression) -> bytes:
    """Return the bytes of a chunk as they go into the file."""
    if compression is Compression.BZ2:
        return bz2.compress(data)
    if compression is Compression.LZ4:
        # roslz4 reads only frames of independent blocks with a checksum and without their size.
        options = {"block_size": 6, "block_linked": False, "store_size": False}
        frame: bytes = _lz4().compress(data, content_checksum=True, **options)
        return frame
    return data


def decompress(data: bytes, compression: str, size: int) -> bytes:
    """Return the bytes of a chunk.

    Raises:
        BagError: the compression is not known, or the bytes are damaged.
    """
    if compression == Compression.NONE:
        return data
    if compression not in set(Compression):
        raise BagError(f"unknown compression type: {compression} (none, bz2 and lz4 are known)")
    return decompressed(data, compression, size)


def message_at(data: bytes, offset: int) -> bytes:
    """Return the message of the record at an offset.

    Raises:
        BagError: there is none.
    """
    try:
        (header_size,) = _LENGTH.unpack_from(data, offset)
        (size,) = _LENGTH.unpack_from(data, offset + 4 + header_size)
    except struct.error:
        raise BagError("a chunk's index names a place outside of it") from None
    start = offset + 8 + header_size
    if start + size > len(data):
        raise BagError("a chunk's index names a place outside of it")
    return data[start : start + size]


def entries_in(data: bytes) -> Iterator[Entry]:
    """Yield what the index of a chunk would hold.

    Raises:
        BagError: the bytes are no records.
    """
    for offset, fields, _ in _records(data):
        if fields.get("op") == bytes([Op.MESSAGE]):
            yield _number(fields, "conn"), unpack_stamp(fields.get("time", b"")), offset


def connections_in(data: bytes) -> Iterator[Connection]:
    """Yield the connections that a chunk introduces.

    Raises:
        BagError: the bytes are no records.
    """
    for _, fields, (start, size) in _records(data):
        if fields.get("op") == bytes([Op.CONNECTION]):
            yield connection_of(fields, data[start : start + size])


def connection_of(fields: dict[str, bytes], data: bytes) -> Connection:
    """Return the connection of a record's header and data."""
    inner = {name: text.decode("utf-8", "replace") for name, text in read_fields(data).items()}
    topic = fields.get("topic", b"").decode("utf-8", "replace") or inner.get("topic", "")
    return Connection(
        _number(fields, "conn"),
        topic,
        inner.get("type", "*"),
        Encoding.ROS1,
        inner.get("message_definition", ""),
        inner.get("md5sum", ""),
        inner.get("callerid", ""),
        inner.get("latching", "0") == "1",
    )


def _number(fields: dict[str, bytes], name: str) -> int:
    value = fields.get(name, b"")
    if len(value) != 4:
        raise BagError(f"a record lacks its field '{name}'")
    return int(_LENGTH.unpack(value)[0])


def _records(data: bytes) -> Iterator[tuple[int, dict[str, bytes], tuple[int, int]]]:
    offset = 0
    while offset < len(data):
        try:
            (header_size,) = _LENGTH.unpack_from(data, offset)
            fields = read_fields(data[offset + 4 : offset + 4 + header_size])
            (size,) = _LENGTH.unpack_from(data, offset + 4 + header_size)
        except struct.error:
            raise BagError("a chunk ends in the middle of a record") from None
        start = offset + 8 + header_size
        yield offset, fields, (start, size)
        offset = start + size


def _lz4() -> Any:
    import lz4.frame

    return lz4.frame
