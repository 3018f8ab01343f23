"""The chunks and connections of a ``.bag``, from its index or, without one, from its chunks."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path
from typing import BinaryIO

import numpy as np

from gazelle.bag.ros1.chunks import Chunk, connection_of, connections_in, decompress, entries_in
from gazelle.bag.ros1.records import MAGIC, Op, RecordHeader, read_record, unpack_stamp
from gazelle.bag.storage import BagError, Connection

__all__ = ["Structure", "read_structure"]


@dataclass(slots=True)
class Structure:
    """What a file is made of.

    Attributes:
        connections: by number.
        chunks: in the order of the file.
        is_indexed: read from the index at the end.
        lost: bytes at the end that are no whole chunk.
        end: where the last whole chunk and its index end.
    """

    connections: dict[int, Connection] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)
    is_indexed: bool = True
    lost: int = 0
    end: int = 0


def read_structure(file: BinaryIO, path: Path) -> Structure:
    """Return the structure of a file that starts with the magic.

    Raises:
        BagError: its header is damaged.
    """
    end = file.seek(0, 2)
    header = read_record(file, len(MAGIC), end)
    if header is None or header.op != Op.FILE:
        if header is None and end <= len(MAGIC) + 4096:
            return Structure(is_indexed=False, lost=end - len(MAGIC), end=len(MAGIC))
        raise BagError(f"{path}: the bag's file header is damaged")
    index_position = int.from_bytes(header.fields.get("index_pos", b""), "little")
    if 0 < index_position <= end:
        try:
            return _indexed(file, index_position, end)
        except BagError:
            # An index that cannot be read is as good as none: the chunks tell the same.
            pass
    return _scanned(file, header.end, end)


def _indexed(file: BinaryIO, position: int, end: int) -> Structure:
    found = Structure(end=position)
    infos: list[RecordHeader] = []
    while position < end:
        record = read_record(file, position, end)
        if record is None:
            raise BagError("the index ends in the middle")
        if record.op == Op.CONNECTION:
            one = connection_of(record.fields, _data(file, record))
            found.connections[one.id] = one
        elif record.op == Op.CHUNK_INFO:
            infos.append(record)
        elif record.op == Op.CHUNK:
            raise BagError("somebody was appending to the bag: chunks follow its index")
        position = record.end
    for info in infos:
        found.chunks.append(_chunk_of_info(file, info, found.end))
    found.chunks.sort(key=lambda chunk: chunk.position)
    for chunk, after in zip_longest(found.chunks, found.chunks[1:]):
        chunk.end = after.position if after is not None else found.end
    return found


def _chunk_of_info(file: BinaryIO, info: RecordHeader, end: int) -> Chunk:
    position = int.from_bytes(info.fields.get("chunk_pos", b""), "little")
    record = read_record(file, position, end)
    if record is None or record.op != Op.CHUNK:
        raise BagError(f"there is no chunk at byte {position}, where the index says one is")
    chunk = _chunk(position, record)
    chunk.start_ns = unpack_stamp(info.fields.get("start_time", b""))
    chunk.end_ns = unpack_stamp(info.fields.get("end_time", b""))
    counts = np.frombuffer(_data(file, info), "<u4")
    chunk.counts = dict(zip(counts[::2].tolist(), counts[1::2].tolist(), strict=False))
    return chunk


def _scanned(file: BinaryIO, position: int, end: int) -> Structure:
    """Go from record to record; stop at the first that is not there as a whole."""
    found = Structure(is_indexed=False, end=position)
    while position < end:
        try:
            record = read_record(file, position, end)
            if record is None:
                break
            if record.op == Op.CHUNK:
                _scan_chunk(file, found, _chunk(position, record), end)
                position = found.chunks[-1].end
            else:
                position = record.end
        except BagError:
            break
        found.end = position
    found.lost = end - found.end
    return found


def _scan_chunk(file: BinaryIO, found: Structure, chunk: Chunk, end: int) -> None:
    position = chunk.start + chunk.size
    while (record := _index_record(file, position, end)) is not None:
        _count_index(file, chunk, record)
        position = record.end
    chunk.end = position
    if chunk.counts and chunk.counts.keys() <= found.connections.keys():
        found.chunks.append(chunk)
        return
    # It introduces a connection, or the writer was killed before its index.
    file.seek(chunk.start)
    data = decompress(file.read(chunk.size), chunk.compression, chunk.uncompressed)
    found.connections.update((one.id, one) for one in connections_in(data))
    _count_entries(chunk, data)
    found.chunks.append(chunk)


def _index_record(file: BinaryIO, position: int, end: int) -> RecordHeader | None:
    try:
        record = read_record(file, position, end)
    except BagError:
        return None
    return record if record is not None and record.op == Op.INDEX else None


def _count_index(file: BinaryIO, chunk: Chunk, record: RecordHeader) -> None:
    number = int.from_bytes(record.fields.get("conn", b""), "little")
    entries = np.frombuffer(_data(file, record)[: record.size // 12 * 12], "<u4").reshape(-1, 3)
    if not len(entries):
        return
    stamps = entries[:, 0].astype("i8") * 1_000_000_000 + entries[:, 1]
    _widen(chunk, int(stamps.min()), int(stamps.max()))
    chunk.counts[number] = chunk.counts.get(number, 0) + len(entries)


def _count_entries(chunk: Chunk, data: bytes) -> None:
    chunk.counts = {}
    for number, stamp, _ in entries_in(data):
        _widen(chunk, stamp, stamp)
        chunk.counts[number] = chunk.counts.get(number, 0) + 1


def _widen(chunk: Chunk, start_ns: int, end_ns: int) -> None:
    chunk.start_ns = min(chunk.start_ns or start_ns, start_ns)
    chunk.end_ns = max(chunk.end_ns, end_ns)


def _chunk(position: int, record: RecordHeader) -> Chunk:
    compression = record.fields.get("compression", b"none").decode("ascii", "replace")
    size = int.from_bytes(record.fields.get("size", b""), "little")
    return Chunk(position, compression, record.start, record.size, size)


def _data(file: BinaryIO, record: RecordHeader) -> bytes:
    file.seek(record.start)
    return file.read(record.size)
