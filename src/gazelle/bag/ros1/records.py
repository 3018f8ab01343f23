"""Records and their headers: ``<length><header><length><data>``, headers of ``name=value``."""

from __future__ import annotations

import enum
import struct
from typing import BinaryIO, NamedTuple

from gazelle.bag.storage import BagError

__all__ = ["MAGIC", "Op", "RecordHeader", "pack_fields", "pack_stamp", "read_fields", "read_record"]
__all__ += ["unpack_stamp"]

MAGIC = b"#ROSBAG V2.0\n"
_LENGTH = struct.Struct("<I")
_STAMP = struct.Struct("<II")
_MAX_HEADER = 1 << 24


class Op(enum.IntEnum):
    """What a record is."""

    MESSAGE = 0x02
    FILE = 0x03
    INDEX = 0x04
    CHUNK = 0x05
    CHUNK_INFO = 0x06
    CONNECTION = 0x07


class RecordHeader(NamedTuple):
    """A record's header, and where its data lie."""

    fields: dict[str, bytes]
    start: int
    size: int

    @property
    def op(self) -> int:
        """What the record is; 0 when it does not say."""
        value = self.fields.get("op", b"\0")
        return value[0] if value else 0

    @property
    def end(self) -> int:
        """Where the next record starts."""
        return self.start + self.size


def pack_fields(**fields: bytes) -> bytes:
    """Return a header without its length."""
    pairs = (name.encode() + b"=" + value for name, value in fields.items())
    return b"".join(_LENGTH.pack(len(pair)) + pair for pair in pairs)


def read_fields(data: bytes) -> dict[str, bytes]:
    """Return the fields of a header.

    Raises:
        BagError: the bytes are not a header.
    """
    fields, offset = {}, 0
    while offset < len(data):
        if offset + 4 > len(data):
            raise BagError("a record's header ends in the middle of a field")
        (length,) = _LENGTH.unpack_from(data, offset)
        pair = data[offset + 4 : offset + 4 + length]
        name, equals, value = pair.partition(b"=")
        if len(pair) != length or not equals:
            raise BagError("a record's header holds no field `name=value` where one must be")
        fields[name.decode("utf-8", "replace")] = value
        offset += 4 + length
    return fields


def read_record(file: BinaryIO, start: int, end: int) -> RecordHeader | None:
    """Return the record that starts at an offset; None when it is not there as a whole.

    Raises:
        BagError: the bytes are not a record.
    """
    if start + 4 > end:
        return None
    file.seek(start)
    (header_size,) = _LENGTH.unpack(_exactly(file, 4) or b"\0\0\0\0")
    if start + 8 + header_size > end:
        return None
    if header_size > _MAX_HEADER:
        raise BagError(f"a record's header claims {header_size} bytes")
    header, length = _exactly(file, header_size), _exactly(file, 4)
    if header is None or length is None:
        return None
    record = RecordHeader(read_fields(header), start + 8 + header_size, _LENGTH.unpack(length)[0])
    return record if record.end <= end else None


def pack_stamp(stamp_ns: int) -> bytes:
    """Return a time: seconds and nanoseconds."""
    return _STAMP.pack(*divmod(stamp_ns, 1_000_000_000))


def unpack_stamp(data: bytes) -> int:
    """Return the nanoseconds of a time.

    Raises:
        BagError: the bytes are too few.
    """
    if len(data) < 8:
        raise BagError("a record lacks its time")
    seconds, nanoseconds = _STAMP.unpack_from(data)
    return int(seconds) * 1_000_000_000 + int(nanoseconds)


def _exactly(file: BinaryIO, size: int) -> bytes | None:
    data = file.read(size)
    return data if len(data) == size else None
