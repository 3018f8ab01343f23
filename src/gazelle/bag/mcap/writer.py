"""Writing MCAP files."""

from __future__ import annotations

import struct
from array import array
from dataclasses import replace
from pathlib import Path

from gazelle.bag.append_only_file import AppendedFile
from gazelle.bag.mcap.chunks import Chunk, compress, message_head
from gazelle.bag.mcap.records import HEAD, MAGIC, Op, pack_map, pack_record, pack_string
from gazelle.bag.storage import Connection, Encoding, Storage

__all__ = ["McapWriter"]

CHUNK_BYTES = 768 * 1024
_PROFILE, _LIBRARY = "ros2", "gazelle"


class McapWriter:
    """Writes an MCAP file chunk by chunk; chunks that are in the file never change.

    Attributes:
        path: the file.
        compression: of the chunks: empty, ``lz4`` or ``zstd``.
    """

    storage: str = Storage.MCAP
    encoding = Encoding.CDR

    def __init__(
        self, path: Path, *, compression: str = "", chunk_bytes: int = CHUNK_BYTES
    ) -> None:
        """Create the file.

        Raises:
            BagError: the file system refuses it.
        """
        self.path = path
        self.compression = compression
        self._chunk_bytes = chunk_bytes
        self._file = AppendedFile(path)
        header = pack_record(Op.HEADER, pack_string(_PROFILE), pack_string(_LIBRARY))
        self._file.append([MAGIC, header])
        self._schemas: dict[tuple[str, str], int] = {}
        self._connections: dict[int, Connection] = {}
        self._introduced: set[int] = set()
        self._introductions: list[bytes] = []
        self._chunks: list[Chunk] = []
        self._pieces: list[bytes] = []
        self._filled = 0
        self._index: dict[int, array[int]] = {}
        self._sequences: dict[int, int] = {}
        self._closed = False

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait included."""
        return self._file.size + self._filled

    def add(self, connection: Connection) -> Connection:
        """Add a channel; returns it with its number in this bag."""
        own = replace(connection, id=len(self._connections) + 1)
        self._connections[own.id] = own
        return own

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message."""
        number = connection.id
        if number not in self._introduced:
            self._introduce(number)
        self._index.setdefault(number, array("Q")).extend((stamp_ns, self._filled))
        sequence = self._sequences[number] = self._sequences.get(number, -1) + 1
        self._put(message_head(number, sequence, stamp_ns, len(data)))
        self._put(data)
        if self._filled >= self._chunk_bytes:
            self.flush()

    @property
    def restored(self) -> int:
        """How often the file was written anew because somebody had removed it."""
        return self._file.restored

    def flush(self) -> None:
        """Write the chunk that is being filled into the file."""
        if not self._filled:
            return
        stamps = [(min(one[::2]), max(one[::2])) for one in self._index.values()]
        start_ns, end_ns = min(low for low, _ in stamps), max(high for _, high in stamps)
        pieces, size, position = self._pieces, self._filled, self._file.size
        if self.compression:
            packed = compress(b"".join(pieces), self.compression)
            pieces, size = [packed], len(packed)
        fixed = struct.pack("<QQQI", start_ns, end_ns, self._filled, 0)
        fixed += pack_string(self.compression) + struct.pack("<Q", size)
        head = HEAD.pack(Op.CHUNK, len(fixed) + size) + fixed
        chunk = Chunk(
            position, start_ns, end_ns, self.compression, position + len(head), size, self._filled
        )
        chunk.length = len(head) + size
        index, offset = [], position + chunk.length
        for number, entries in self._index.items():
            index.append(_message_index(number, entries))
            chunk.indexes[number], chunk.counts[number] = offset, len(entries) // 2
            offset += len(index[-1])
        chunk.index_length = sum(map(len, index))
        self._file.append([head, *pieces, *index])
        self._chunks.append(chunk)
        self._pieces, self._filled, self._index = [], 0, {}

    def close(self) -> None:
        """Write the summary; calling it twice does nothing."""
        if self._closed:
            return
        self.flush()
        self._closed = True
        self._file.append([pack_record(Op.DATA_END, struct.pack("<I", 0))])
        start = self._file.size
        groups = (
            (Op.SCHEMA, [one for one in self._introductions if one[0] == Op.SCHEMA]),
            (Op.CHANNEL, [one for one in self._introductions if one[0] == Op.CHANNEL]),
            (Op.STATISTICS, [self._statistics()]),
            (Op.CHUNK_INDEX, [_chunk_index(one) for one in self._chunks]),
        )
        offsets = []
        for op, records in groups:
            offset = self._file.size
            self._file.append(records)
            if records:
                span = struct.pack("<BQQ", op, offset, self._file.size - offset)
                offsets.append(pack_record(Op.SUMMARY_OFFSET, span))
        footer = struct.pack("<QQI", start, self._file.size, 0)
        self._file.append([*offsets, pack_record(Op.FOOTER, footer), MAGIC])
        self._file.close()

    def _introduce(self, number: int) -> None:
        one = self._connections[number]
        self._introduced.add(number)
        key = (one.type_name, one.definition)
        if key not in self._schemas:
            schema = self._schemas[key] = len(self._schemas) + 1
            words = pack_string(one.type_name) + pack_string("ros2msg")
            text = pack_string(one.definition)
            self._say(pack_record(Op.SCHEMA, struct.pack("<H", schema), words, text))
        about = {"offered_qos_profiles": one.qos}
        if one.type_hash:
            about["topic_type_hash"] = one.type_hash
        numbers = struct.pack("<HH", number, self._schemas[key])
        words = pack_string(one.topic) + pack_string("cdr")
        self._say(pack_record(Op.CHANNEL, numbers, words, pack_map(about)))

    def _say(self, record: bytes) -> None:
        self._introductions.append(record)
        self._put(record)

    def _put(self, data: bytes) -> None:
        self._pieces.append(data)
        self._filled += len(data)

    def _statistics(self) -> bytes:
        counts: dict[int, int] = {}
        for chunk in self._chunks:
            for number, count in chunk.counts.items():
                counts[number] = counts.get(number, 0) + count
        table = b"".join(struct.pack("<HQ", *pair) for pair in sorted(counts.items()))
        numbers = (sum(counts.values()), len(self._schemas), len(self._introduced), 0, 0)
        start_ns = min((one.start_ns for one in self._chunks), default=0)
        end_ns = max((one.end_ns for one in self._chunks), default=0)
        fixed = struct.pack("<QHIIIIQQ", *numbers, len(self._chunks), start_ns, end_ns)
        return pack_record(Op.STATISTICS, fixed, struct.pack("<I", len(table)), table)


def _message_index(number: int, entries: array[int]) -> bytes:
    data = entries.tobytes()
    return pack_record(Op.MESSAGE_INDEX, struct.pack("<HI", number, len(data)), data)


def _chunk_index(chunk: Chunk) -> bytes:
    offsets = b"".join(struct.pack("<HQ", *pair) for pair in chunk.indexes.items())
    times = (chunk.start_ns, chunk.end_ns, chunk.position, chunk.length)
    return pack_record(
        Op.CHUNK_INDEX,
        struct.pack("<QQQQI", *times, len(offsets)),
        offsets,
        struct.pack("<Q", chunk.index_length),
        pack_string(chunk.compression),
        struct.pack("<QQ", chunk.size, chunk.uncompressed),
    )
