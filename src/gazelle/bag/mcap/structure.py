"""The chunks and channels of an MCAP file, from its summary or, without one, from its records."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import BinaryIO

from gazelle.bag.mcap.chunks import (
    Chunk,
    Schema,
    decompress,
    messages_in,
    read_channel,
    read_schema,
)
from gazelle.bag.mcap.records import HEAD, MAGIC, Cursor, Op, Record, records_in
from gazelle.bag.storage import BagError, Connection

__all__ = ["LOOSE", "Structure", "read_structure"]

LOOSE = "loose"
"""Stands for the compression of messages that lie outside of chunks."""

_FOOTER_BYTES = HEAD.size + 20 + len(MAGIC)


@dataclass(slots=True)
class Structure:
    """What a file is made of.

    Attributes:
        profile: what the header says, such as ``ros2``.
        connections: by the channel's number.
        schemas: by number.
        chunks: in the order of the file; runs of loose messages count as chunks.
        is_indexed: read from the summary at the end.
        lost: bytes at the end that are no whole record.
    """

    profile: str = ""
    connections: dict[int, Connection] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)
    is_indexed: bool = True
    lost: int = 0


def read_structure(file: BinaryIO) -> Structure:
    """Return the structure of a file that starts with the magic."""
    end = file.seek(0, 2)
    found = _summarised(file, end)
    return _scanned(file, end) if found is None else found


def _summarised(file: BinaryIO, end: int) -> Structure | None:
    """Read the summary; None when it is missing or does not tell everything."""
    file.seek(max(end - _FOOTER_BYTES, 0))
    tail = file.read(_FOOTER_BYTES)
    if len(tail) != _FOOTER_BYTES or tail[-len(MAGIC) :] != MAGIC or tail[0] != Op.FOOTER:
        return None
    start, _, _ = Cursor(tail[HEAD.size :]).numbers("QQI")
    if not len(MAGIC) < start < end:
        return None
    file.seek(start)
    data = file.read(end - _FOOTER_BYTES - start)
    found = Structure(profile=_profile(file))
    counts: dict[int, int] = {}
    try:
        for record in records_in(data):
            content = data[record.start : record.end]
            _introduce(found, record.op, content)
            if record.op == Op.CHUNK_INDEX:
                found.chunks.append(_chunk_of_index(content, end))
            elif record.op == Op.STATISTICS:
                counts = _counts(content)
        if not found.chunks and any(counts.values()):
            return None
        for chunk in found.chunks:
            _count_chunk(file, found, chunk, end)
    except BagError:
        return None
    known = {number for chunk in found.chunks for number in chunk.counts}
    return found if known <= found.connections.keys() else None


def _scanned(file: BinaryIO, end: int) -> Structure:
    found = Structure(is_indexed=False, profile=_profile(file))
    position = len(MAGIC)
    while position < end:
        record = _record(file, position, end)
        if record is None or record.op in (Op.DATA_END, Op.FOOTER):
            break
        try:
            if record.op == Op.CHUNK:
                chunk = _chunk(file, position, record)
                _count_chunk(file, found, chunk, end)
                found.chunks.append(chunk)
            elif record.op == Op.MESSAGE:
                _take_loose(file, found, position, record)
            elif record.op in (Op.SCHEMA, Op.CHANNEL):
                _introduce(found, record.op, _content(file, record))
        except BagError:
            break
        position = record.end
    found.lost = end - position if _record(file, position, end) is None else 0
    return found


def _profile(file: BinaryIO) -> str:
    record = _record(file, len(MAGIC), file.seek(0, 2))
    if record is None or record.op != Op.HEADER:
        return ""
    return Cursor(_content(file, record)).string()


def _record(file: BinaryIO, position: int, end: int) -> Record | None:
    file.seek(position)
    head = file.read(HEAD.size)
    if len(head) != HEAD.size:
        return None
    op, size = HEAD.unpack(head)
    record = Record(op, position + HEAD.size, size)
    return record if record.end <= end else None


def _content(file: BinaryIO, record: Record) -> bytes:
    file.seek(record.start)
    return file.read(record.size)


def _introduce(found: Structure, op: int, content: bytes) -> None:
    if op == Op.SCHEMA:
        number, schema = read_schema(content)
        found.schemas.setdefault(number, schema)
    elif op == Op.CHANNEL:
        one = read_channel(content, found.schemas)
        found.connections.setdefault(one.id, one)


def _chunk(file: BinaryIO, position: int, record: Record) -> Chunk:
    file.seek(record.start)
    cursor = Cursor(file.read(min(record.size, 4096)))
    start_ns, end_ns, uncompressed, _ = cursor.numbers("QQQI")
    compression = cursor.string()
    (size,) = cursor.numbers("Q")
    start = record.end - size
    if start < record.start:
        raise BagError(f"a chunk of {record.size} bytes cannot hold {size}")
    chunk = Chunk(position, start_ns, end_ns, compression, start, size, uncompressed)
    chunk.length = record.end - position
    return chunk


def _chunk_of_index(content: bytes, end: int) -> Chunk:
    cursor = Cursor(content)
    start_ns, end_ns, position, length = cursor.numbers("QQQQ")
    cursor.block()
    cursor.numbers("Q")
    compression = cursor.string()
    size, uncompressed = cursor.numbers("QQ")
    start = position + length - size
    if start < position or position + length > end:
        raise BagError(f"there is no chunk at byte {position}, where the index says one is")
    chunk = Chunk(position, start_ns, end_ns, compression, start, size, uncompressed)
    chunk.length = length
    return chunk


def _counts(content: bytes) -> dict[int, int]:
    cursor = Cursor(content)
    cursor.numbers("QHIIIIQQ")
    inner, counts = Cursor(cursor.block()), {}
    while not inner.at_end:
        number, count = inner.numbers("HQ")
        counts[number] = count
    return counts


def _count_chunk(file: BinaryIO, found: Structure, chunk: Chunk, end: int) -> None:
    """Count by the indexes behind the chunk, else by what is in it."""
    position = chunk.position + chunk.length
    while (record := _record(file, position, end)) and record.op == Op.MESSAGE_INDEX:
        cursor = Cursor(_content(file, record))
        number, size = cursor.numbers("HI")
        if size:
            chunk.counts[number] = chunk.counts.get(number, 0) + size // 16
        position = record.end
    if chunk.counts and chunk.counts.keys() <= found.connections.keys():
        return
    file.seek(chunk.start)
    data = decompress(file.read(chunk.size), chunk.compression, chunk.uncompressed)
    chunk.counts = {}
    for record in records_in(data):
        if record.op in (Op.SCHEMA, Op.CHANNEL):
            _introduce(found, record.op, data[record.start : record.end])
    for number, _, _ in messages_in(data):
        chunk.counts[number] = chunk.counts.get(number, 0) + 1


def _take_loose(file: BinaryIO, found: Structure, position: int, record: Record) -> None:
    number, _, stamp_ns, _ = Cursor(_content(file, record)).numbers("HIQQ")
    last = found.chunks[-1] if found.chunks else None
    if last is None or last.compression != LOOSE or last.start + last.size != position:
        last = Chunk(position, stamp_ns, stamp_ns, LOOSE, position, 0, 0)
        found.chunks.append(last)
    last.size = last.uncompressed = record.end - last.start
    last.start_ns, last.end_ns = min(last.start_ns, stamp_ns), max(last.end_ns, stamp_ns)
    last.counts[number] = last.counts.get(number, 0) + 1
