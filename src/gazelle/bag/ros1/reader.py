"""Reading ``.bag`` files, finished ones and those whose writer was killed."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from gazelle.bag.ros1.chunks import Chunk, decompress, entries_in, message_at
from gazelle.bag.ros1.index import Structure, read_structure
from gazelle.bag.ros1.records import MAGIC, Op, read_record
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

__all__ = ["Ros1Bag"]

_ENTRY = np.dtype([("sec", "<u4"), ("nsec", "<u4"), ("offset", "<u4")])
_ROW = np.dtype([("stamp", "i8"), ("chunk", "i4"), ("offset", "u4"), ("conn", "i4")])
_KEPT_CHUNKS = 8


@shown_by("bags:bag_bundle")
class Ros1Bag:
    """An open ``.bag``.

    Attributes:
        path: the file.
        is_indexed: it was closed properly; ``rosbag reindex`` is not needed.
    """

    storage: str = Storage.ROS1
    version = "2.0"

    def __init__(self, path: Path) -> None:
        """Open a file.

        Raises:
            BagError: it cannot be read or is not such a bag.
        """
        self.path = path
        self._file = _open(path)
        try:
            self._structure: Structure = read_structure(self._file, path)
        except BaseException:
            self._file.close()
            raise
        self.is_indexed = self._structure.is_indexed
        self._kept: OrderedDict[int, bytes] = OrderedDict()

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All connections, by number."""
        return tuple(one for _, one in sorted(self._structure.connections.items()))

    @property
    def chunks(self) -> tuple[Chunk, ...]:
        """All chunks, in the order of the file."""
        return tuple(self._structure.chunks)

    @property
    def summary(self) -> Summary:
        """What is in it."""
        chunks = self._structure.chunks
        filled = [one for one in chunks if one.counts]
        return Summary(
            counts_of(chunks),
            min((one.start_ns for one in filled), default=0),
            max((one.end_ns for one in filled), default=0),
            self.path.stat().st_size,
            packs_of(chunks),
            self.is_indexed,
            self._structure.lost,
        )

    def stamps(self, wanted: Wanted | None = None) -> list[int]:
        """Return the stamps of messages, sorted, without reading the messages."""
        return [int(stamp) for stamp in self._rows(wanted, None, None)["stamp"]]

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` connections between two stamps.

        Raises:
            BagError: a chunk is damaged.
        """
        connections = self._structure.connections
        for stamp, chunk_number, offset, number in self._rows(wanted, start_ns, end_ns).tolist():
            data = self._chunk_data(chunk_number)
            yield BagMessage(connections[number], stamp, message_at(data, offset))

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _rows(self, wanted: Wanted | None, start_ns: int | None, end_ns: int | None) -> Any:
        numbers = {
            number
            for number, one in self._structure.connections.items()
            if wanted is None or wanted(one)
        }
        tables = []
        for index, chunk in enumerate(self._structure.chunks):
            outside = (start_ns is not None and chunk.end_ns < start_ns) or (
                end_ns is not None and chunk.start_ns > end_ns
            )
            if not outside and numbers & chunk.counts.keys():
                tables += self._chunk_rows(index, chunk, numbers)
        rows = np.concatenate(tables) if tables else np.zeros(0, _ROW)
        if start_ns is not None:
            rows = rows[rows["stamp"] >= start_ns]
        if end_ns is not None:
            rows = rows[rows["stamp"] <= end_ns]
        return rows[np.lexsort((rows["offset"], rows["chunk"], rows["stamp"]))]

    def _chunk_rows(self, chunk_number: int, chunk: Chunk, numbers: set[int]) -> list[Any]:
        found, known, position = [], set(), chunk.start + chunk.size
        while position < chunk.end:
            record = read_record(self._file, position, chunk.end)
            if record is None or record.op != Op.INDEX:
                break
            number = int.from_bytes(record.fields.get("conn", b""), "little")
            known.add(number)
            if number in numbers:
                self._file.seek(record.start)
                entries = np.frombuffer(self._file.read(record.size // 12 * 12), _ENTRY)
                found.append(_table(chunk_number, number, entries))
            position = record.end
        if known != set(chunk.counts):
            return self._parsed_rows(chunk_number, numbers)
        return found

    def _parsed_rows(self, chunk_number: int, numbers: set[int]) -> list[Any]:
        """Rows of a chunk whose index is not there."""
        entries = [one for one in entries_in(self._chunk_data(chunk_number)) if one[0] in numbers]
        rows = np.zeros(len(entries), _ROW)
        for row, (number, stamp, offset) in enumerate(entries):
            rows[row] = (stamp, chunk_number, offset, number)
        return [rows]

    def _chunk_data(self, chunk_number: int) -> bytes:
        data = self._kept.get(chunk_number)
        if data is None:
            chunk = self._structure.chunks[chunk_number]
            self._file.seek(chunk.start)
            packed = self._file.read(chunk.size)
            data = decompress(packed, chunk.compression, chunk.uncompressed)
            self._kept[chunk_number] = data
            if len(self._kept) > _KEPT_CHUNKS:
                self._kept.popitem(last=False)
        return data


def _table(chunk_number: int, number: int, entries: Any) -> Any:
    rows = np.empty(len(entries), _ROW)
    rows["stamp"] = entries["sec"].astype("i8") * 1_000_000_000 + entries["nsec"]
    rows["chunk"], rows["offset"], rows["conn"] = chunk_number, entries["offset"], number
    return rows


def _open(path: Path) -> BinaryIO:
    try:
        file = path.open("rb")
    except OSError as error:
        raise BagError(f"Error opening file: {path}: {error.strerror}") from None
    start = file.read(len(MAGIC))
    if start == MAGIC:
        return file
    file.close()
    if start.startswith(b"#ROSBAG V1") or start.startswith(b"#ROSRECORD"):
        version = start.decode("ascii", "replace").split("V")[-1].strip()
        raise BagError(
            f"{path}: this is a bag of version {version}, older than 2.0 (ROS C-Turtle, 2010); "
            "`rosbag fix` of ROS Noetic makes a bag of version 2.0 of it"
        )
    raise BagError(f"{path}: This does not appear to be a bag file")
