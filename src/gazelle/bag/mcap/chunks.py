"""Chunks of MCAP: how they are compressed, and what lies in them."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.bag.compression_formats import compress_zstd, decompressed
from gazelle.bag.mcap.records import HEAD, Cursor, Op, records_in
from gazelle.bag.storage import BagError, Connection, Encoding

__all__ = ["Chunk", "Schema", "compress", "decompress", "message_head", "messages_in"]
__all__ += ["read_channel", "read_schema"]

_MESSAGE = struct.Struct("<HIQQ")


@dataclass(slots=True)
class Chunk:
    """One chunk of a file.

    Attributes:
        position: where its record starts.
        start_ns, end_ns: stamps of the first and last message.
        compression: empty, ``lz4`` or ``zstd``.
        start, size: where its bytes lie and how many they are.
        uncompressed: how many they are once decompressed.
        length: of the whole record.
        indexes: where the index of each channel lies.
        index_length: bytes of all of them together.
        counts: messages by channel.
    """

    position: int
    start_ns: int
    end_ns: int
    compression: str
    start: int
    size: int
    uncompressed: int
    length: int = 0
    indexes: dict[int, int] = field(default_factory=dict)
    index_length: int = 0
    counts: dict[int, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Schema:
    """A type: its name, how it is defined and the definition."""

    name: str
    encoding: str
    text: str


def compress(data: bytes, compression: str) -> bytes:
    """Return the bytes of a chunk as they go into the file."""
    if compression == "lz4":
        import lz4.frame

        frame: bytes = lz4.frame.compress(data)
        return frame
    if compression == "zstd":
        return compress_zstd(data)
    return data


def decompress(data: bytes, compression: str, size: int) -> bytes:
    """Return the bytes of a chunk.

    Raises:
        BagError: the compression is not known, or the bytes are damaged.
    """
    if not compression:
        return data
    if compression not in ("lz4", "zstd"):
        raise BagError(f"a chunk is compressed with '{compression}' (lz4 and zstd are known)")
    return decompressed(data, compression, size)


def read_schema(content: bytes) -> tuple[int, Schema]:
    """Return number and schema of a record's content."""
    cursor = Cursor(content)
    (number,) = cursor.numbers("H")
    name, encoding = cursor.string(), cursor.string()
    return number, Schema(name, encoding, cursor.block().decode("utf-8", "replace"))


def read_channel(content: bytes, schemas: dict[int, Schema]) -> Connection:
    """Return the connection that a channel's content describes."""
    cursor = Cursor(content)
    number, schema_number = cursor.numbers("HH")
    topic, encoding, about = cursor.string(), cursor.string(), cursor.map()
    schema = schemas.get(schema_number, Schema("", "", ""))
    return Connection(
        number,
        topic,
        schema.name,
        Encoding.ROS1 if encoding == "ros1" else Encoding.CDR,
        schema.text,
        about.get("md5sum", ""),
        about.get("callerid", ""),
        about.get("latching", "") in ("1", "true"),
        about.get("offered_qos_profiles", ""),
        about.get("topic_type_hash", ""),
    )


def messages_in(data: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Yield channel, stamp and bytes of the messages in a chunk."""
    for record in records_in(data):
        if record.op == Op.MESSAGE:
            number, _, stamp_ns, _ = _MESSAGE.unpack_from(data, record.start)
            yield number, stamp_ns, data[record.start + _MESSAGE.size : record.end]


def message_head(number: int, sequence: int, stamp_ns: int, size: int) -> bytes:
    """Return what stands before a message's bytes."""
    head = HEAD.pack(Op.MESSAGE, _MESSAGE.size + size)
    return head + _MESSAGE.pack(number, sequence & 0xFFFFFFFF, stamp_ns, stamp_ns)
