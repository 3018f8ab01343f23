"""Reading MCAP files, finished ones and those whose writer was killed."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import count
from pathlib import Path
from typing import BinaryIO, NamedTuple

from gazelle.bag.mcap.chunks import (
    Chunk,
    Schema,
    decompress,
    messages_in,
    read_channel,
    read_schema,
)
from gazelle.bag.mcap.records import HEAD, MAGIC, Cursor, Op, Record, records_in
from gazelle.bag.storage import (
    BagError,
    BagMessage,
    Connection,
    Storage,
    Summary,
    Wanted,
    counts_of,
    packs_of,
)
from gazelle.rich_display import shown_by

__all__ = [
    "McapBag",
]

_LOOSE = "loose"
"""Stands for the compression of messages that lie outside of chunks."""
_FOOTER_BYTES = HEAD.size + 20 + len(MAGIC)


@dataclass(slots=True)
class _Structure:
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


class _Piece(NamedTuple):
    """Some messages that are loaded together: the first one's stamp, and how to load them."""

    start_ns: int
    load: Callable[[], Iterable[BagMessage]]


@shown_by("bags:bag_bundle")
class McapBag:
    """An open MCAP file.

    Attributes:
        path: the file.
        is_indexed: it was closed properly.
        profile: what its header says, such as ``ros2``.
    """

    storage: str = Storage.MCAP

    def __init__(self, path: Path) -> None:
        """Open a file.

        Raises:
            BagError: it cannot be read or is not MCAP.
        """
        self.path = path
        try:
            self._file = path.open("rb")
        except OSError as error:
            raise BagError(f"Error opening file: {path}: {error.strerror}") from None
        if self._file.read(len(MAGIC)) != MAGIC:
            self._file.close()
            raise BagError(f"{path}: this is not an MCAP file")
        self._structure: _Structure = _read_structure(self._file)
        self.is_indexed = self._structure.is_indexed
        self.profile = self._structure.profile

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All channels, by number."""
        return tuple(one for _, one in sorted(self._structure.connections.items()))

    @property
    def summary(self) -> Summary:
        """What is in it."""
        chunks = self._structure.chunks
        return Summary(
            counts_of(chunks),
            min((one.start_ns for one in chunks), default=0),
            max((one.end_ns for one in chunks), default=0),
            self.path.stat().st_size,
            packs_of(chunks),
            self.is_indexed,
            self._structure.lost,
        )

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` channels between two stamps.

        Raises:
            BagError: a chunk is damaged.
        """
        numbers = {one.id for one in self.connections if wanted is None or wanted(one)}
        low = 0 if start_ns is None else start_ns
        high = (1 << 64) if end_ns is None else end_ns
        pieces = [
            _Piece(chunk.start_ns, partial(self._load, chunk, numbers, low, high))
            for chunk in self._structure.chunks
            if chunk.end_ns >= low and chunk.start_ns <= high and numbers & chunk.counts.keys()
        ]
        return _by_time(pieces)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _load(self, chunk: Chunk, numbers: set[int], low: int, high: int) -> Iterator[BagMessage]:
        self._file.seek(chunk.start)
        data = self._file.read(chunk.size)
        if chunk.compression != _LOOSE:
            data = decompress(data, chunk.compression, chunk.uncompressed)
        connections = self._structure.connections
        for number, stamp_ns, message in messages_in(data):
            if number in numbers and low <= stamp_ns <= high:
                yield BagMessage(connections[number], stamp_ns, message)


def _read_structure(file: BinaryIO) -> _Structure:
    """Return the structure of a file that starts with the magic."""
    end = file.seek(0, 2)
    found = _summarised(file, end)
    return _scanned(file, end) if found is None else found


def _by_time(pieces: Iterable[_Piece]) -> Iterator[BagMessage]:
    """Yield the messages of all pieces by stamp, those of one stamp as they lie in the file.

    No more pieces are held than overlap.
    """
    waiting: list[tuple[int, int, BagMessage]] = []
    numbers = count()
    for piece in sorted(pieces, key=lambda one: one.start_ns):
        while waiting and waiting[0][0] < piece.start_ns:
            yield heapq.heappop(waiting)[2]
        for message in piece.load():
            heapq.heappush(waiting, (message.stamp_ns, next(numbers), message))
    while waiting:
        yield heapq.heappop(waiting)[2]


def _summarised(file: BinaryIO, end: int) -> _Structure | None:
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
    found = _Structure(profile=_profile(file))
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


def _scanned(file: BinaryIO, end: int) -> _Structure:
    found = _Structure(is_indexed=False, profile=_profile(file))
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


def _introduce(found: _Structure, op: int, content: bytes) -> None:
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


def _count_chunk(file: BinaryIO, found: _Structure, chunk: Chunk, end: int) -> None:
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


def _take_loose(file: BinaryIO, found: _Structure, position: int, record: Record) -> None:
    number, _, stamp_ns, _ = Cursor(_content(file, record)).numbers("HIQQ")
    last = found.chunks[-1] if found.chunks else None
    if last is None or last.compression != _LOOSE or last.start + last.size != position:
        last = Chunk(position, stamp_ns, stamp_ns, _LOOSE, position, 0, 0)
        found.chunks.append(last)
    last.size = last.uncompressed = record.end - last.start
    last.start_ns, last.end_ns = min(last.start_ns, stamp_ns), max(last.end_ns, stamp_ns)
    last.counts[number] = last.counts.get(number, 0) + 1
