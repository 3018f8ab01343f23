"""Writing ``.bag`` files."""

from __future__ import annotations

import struct
from array import array
from dataclasses import replace
from pathlib import Path

from gazelle.bag.append_only_file import AppendedFile
from gazelle.bag.ros1.chunks import CHUNK_BYTES, Chunk, Compression, compress
from gazelle.bag.ros1.index import Structure, read_structure
from gazelle.bag.ros1.records import MAGIC, Op, pack_fields, pack_stamp
from gazelle.bag.storage import BagError, Connection, Encoding, Storage

__all__ = ["Ros1Writer"]

_HEADER_BYTES = 4096
_LENGTH = struct.Struct("<I")
_LONG = struct.Struct("<Q")
_MESSAGE = struct.Struct("<I I3sB I5sI I5sII I")


class Ros1Writer:
    """Writes a ``.bag`` chunk by chunk.

    A chunk goes into the file in one piece, with its index behind it, and nothing that is in the
    file changes later but the header. So a file that nobody closed holds whole chunks and at
    most one broken one at its end.

    Attributes:
        path: the file.
        compression: of the chunks.
    """

    storage: str = Storage.ROS1
    encoding = Encoding.ROS1

    def __init__(
        self,
        path: Path,
        *,
        compression: Compression = Compression.NONE,
        chunk_bytes: int = CHUNK_BYTES,
        append: bool = False,
    ) -> None:
        """Create the file, or go on in one.

        Until it is closed, a bag that is gone on in has its old index, which stays right; its new
        chunks lie behind that. So whoever is killed has lost neither.

        Args:
            path: the file.
            compression: of the chunks.
            chunk_bytes: when a chunk is full.
            append: keep what is in the file.

        Raises:
            BagError: the file system refuses it, or the file to go on in is no such bag.
        """
        self.path = path
        self.compression = compression
        self._chunk_bytes = chunk_bytes
        old = _structure_of(path) if append else None
        end = None
        if old is not None:
            end = path.stat().st_size if old.is_indexed else old.end
        self._file = AppendedFile(path, end)
        self._connections: dict[int, Connection] = {}
        self._introduced: set[int] = set()
        self._chunks: list[Chunk] = []
        self._pieces: list[bytes] = []
        self._filled = 0
        self._index: dict[int, array[int]] = {}
        self._closed = False
        if old is None:
            self._file.append([MAGIC, self._file_header(0)])
            return
        self._connections |= old.connections
        self._introduced |= old.connections.keys()
        self._chunks += old.chunks

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All connections so far."""
        return tuple(self._connections.values())

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait included."""
        return self._file.size + self._filled

    def add(self, connection: Connection) -> Connection:
        """Add a connection; returns it with its number in this bag."""
        own = replace(connection, id=max(self._connections, default=-1) + 1)
        self._connections[own.id] = own
        return own

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message in ROS 1's bytes."""
        number = connection.id
        if number not in self._introduced:
            self._introduced.add(number)
            self._put(_connection_record(self._connections[number]))
        entries = self._index.get(number)
        if entries is None:
            entries = self._index[number] = array("I")
        seconds, nanoseconds = divmod(stamp_ns, 1_000_000_000)
        entries.extend((seconds, nanoseconds, self._filled))
        self._put(_message_head(number, seconds, nanoseconds, len(data)))
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
        position, uncompressed = self._file.size, self._filled
        pieces, size = self._pieces, self._filled
        if self.compression is not Compression.NONE:
            packed = compress(b"".join(pieces), self.compression)
            pieces, size = [packed], len(packed)
        header = pack_fields(
            op=bytes([Op.CHUNK]),
            compression=self.compression.encode(),
            size=_LENGTH.pack(uncompressed),
        )
        head = _LENGTH.pack(len(header)) + header + _LENGTH.pack(size)
        chunk = Chunk(position, self.compression, position + len(head), size, uncompressed)
        _summarise(chunk, self._index)
        index = [_index_record(number, one) for number, one in self._index.items()]
        self._file.append([head, *pieces, *index])
        self._chunks.append(chunk)
        self._pieces, self._filled, self._index = [], 0, {}

    def close(self) -> None:
        """Write the index of the whole file; calling it twice does nothing."""
        if self._closed:
            return
        self.flush()
        self._closed = True
        index_position = self._file.size
        known = [self._connections[number] for number in sorted(self._introduced)]
        records = [_connection_record(one) for one in known]
        self._file.append(records + [_chunk_info(one) for one in self._chunks])
        self._file.replace(self._file_header(index_position), len(MAGIC))
        self._file.close()

    def _put(self, data: bytes) -> None:
        self._pieces.append(data)
        self._filled += len(data)

    def _file_header(self, index_position: int) -> bytes:
        header = pack_fields(
            op=bytes([Op.FILE]),
            index_pos=_LONG.pack(index_position),
            conn_count=_LENGTH.pack(len(self._introduced)),
            chunk_count=_LENGTH.pack(len(self._chunks)),
        )
        padding = _HEADER_BYTES - len(header)
        return b"".join([_LENGTH.pack(len(header)), header, _LENGTH.pack(padding), b" " * padding])


def _structure_of(path: Path) -> Structure:
    try:
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise BagError(f"{path}: this is no bag of version 2.0; nothing is appended")
            return read_structure(file, path)
    except OSError as error:
        raise BagError(f"Error opening file: {path}: {error.strerror}") from None


def _record(header: bytes, data: bytes) -> bytes:
    return b"".join([_LENGTH.pack(len(header)), header, _LENGTH.pack(len(data)), data])


def _connection_record(one: Connection) -> bytes:
    topic = one.topic.encode()
    header = pack_fields(op=bytes([Op.CONNECTION]), conn=_LENGTH.pack(one.id), topic=topic)
    inner = {
        "topic": topic,
        "type": one.type_name.encode(),
        "md5sum": one.md5sum.encode(),
        "message_definition": one.definition.encode(),
    }
    if one.callerid or one.latching:
        # What rosbag record gets from a publisher, and writes by name.
        inner |= {"callerid": one.callerid.encode(), "latching": b"1" if one.latching else b"0"}
        inner = dict(sorted(inner.items()))
    return _record(header, pack_fields(**inner))


def _message_head(number: int, seconds: int, nanoseconds: int, size: int) -> bytes:
    op = (4, b"op=", int(Op.MESSAGE))
    return _MESSAGE.pack(38, *op, 9, b"conn=", number, 13, b"time=", seconds, nanoseconds, size)


def _index_record(number: int, entries: array[int]) -> bytes:
    header = pack_fields(
        op=bytes([Op.INDEX]),
        ver=_LENGTH.pack(1),
        conn=_LENGTH.pack(number),
        count=_LENGTH.pack(len(entries) // 3),
    )
    return _record(header, entries.tobytes())


def _chunk_info(chunk: Chunk) -> bytes:
    header = pack_fields(
        op=bytes([Op.CHUNK_INFO]),
        ver=_LENGTH.pack(1),
        chunk_pos=_LONG.pack(chunk.position),
        start_time=pack_stamp(chunk.start_ns),
        end_time=pack_stamp(chunk.end_ns),
        count=_LENGTH.pack(len(chunk.counts)),
    )
    counts = (struct.pack("<II", number, count) for number, count in chunk.counts.items())
    return _record(header, b"".join(counts))


def _summarise(chunk: Chunk, index: dict[int, array[int]]) -> None:
    stamps: list[int] = []
    for number, entries in index.items():
        chunk.counts[number] = len(entries) // 3
        pairs = zip(entries[::3], entries[1::3], strict=True)
        own = [seconds * 1_000_000_000 + nanoseconds for seconds, nanoseconds in pairs]
        stamps += (min(own), max(own))
    chunk.start_ns, chunk.end_ns = min(stamps), max(stamps)
