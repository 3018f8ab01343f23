"""rosbag.Bag: reading and writing ROS 1 bags; reads those of rosbag2 as well."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.bag import (
    BagError,
    BagReader,
    BagWriter,
    Connection,
    Encoding,
    bag_types,
    converter,
    open_bag,
    ros1_connection,
    ros1_name_of,
)
from gazelle.bag.ros1 import Compression as Packing
from gazelle.bag.ros1 import Ros1Writer
from gazelle.compat.rospy.rostime import Time
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import TypeStore, default_types, from_ros1, to_ros1, types_of

__all__ = [
    "Bag",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
]

_NANO = 1_000_000_000
_CHUNK_BYTES = 768 * 1024


class BagMessage(NamedTuple):
    """A message as `Bag.read_messages` gives it."""

    topic: str
    message: Any
    timestamp: Time


class BagMessageWithConnectionHeader(NamedTuple):
    """A message with the header of its connection."""

    topic: str
    message: Any
    timestamp: Time
    connection_header: dict[str, bytes]


class ROSBagException(Exception):  # noqa: N818 - rosbag's name
    """Something is wrong with a bag."""


class ROSBagFormatException(ROSBagException):
    """A file is no bag."""


class ROSBagUnindexedException(ROSBagException):
    """A bag has no index; raised by nothing here, such bags are read as they are."""


class Compression:
    """How chunks are compressed."""

    NONE = "none"
    BZ2 = "bz2"
    LZ4 = "lz4"


class TopicTuple(NamedTuple):
    """What a bag has of one topic; frequency in Hz, None for less than two messages."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None


class TypesAndTopicsTuple(NamedTuple):
    """Types with their MD5 sums, and topics."""

    msg_types: dict[str, str]
    topics: dict[str, TopicTuple]


class CompressionTuple(NamedTuple):
    """The compression that most chunks have, and bytes before and after."""

    compression: str
    uncompressed: int
    compressed: int


class Bag:
    """A bag, open for reading (``r``), writing (``w``) or appending (``a``).

    Args:
        f: path of the file, or an open file.
        mode: one of those letters.
        compression: ``none``, ``bz2`` or ``lz4``.
        chunk_threshold: bytes of a full chunk.
        allow_unindexed: without effect: bags without index are read in any case.
        options: ``compression`` and ``chunk_threshold`` once more, which count more.
        skip_index: without effect: it would only read such a bag a second time.

    Raises:
        ValueError: mode or compression are not known.
        FileNotFoundError: there is no such file to read.
        ROSBagException: it is no bag, or cannot be written.
    """

    def __init__(
        self,
        f: Any,
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = _CHUNK_BYTES,
        allow_unindexed: bool = False,
        options: dict[str, Any] | None = None,
        skip_index: bool = False,
    ) -> None:
        chosen = options or {}
        compression = chosen.get("compression", compression)
        if mode not in ("r", "w", "a"):
            raise ValueError(f'mode "{mode}" is invalid')
        if compression not in ("none", "bz2", "lz4"):
            raise ValueError("compression must be one of: none, bz2, lz4")
        self.filename = str(f.name if hasattr(f, "read") else f)
        self.mode = mode
        self.version = 200
        self._path = Path(self.filename)
        self._reader: BagReader | None = None
        self._writer: BagWriter | None = None
        self._known: dict[tuple[str, str, str], Connection] = {}
        self._types = default_types()
        self._closed = False
        if mode == "r":
            self._open_reader()
        else:
            self._open_writer(mode, compression, chosen.get("chunk_threshold", chunk_threshold))

    def __enter__(self) -> Bag:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Any]:
        return self.read_messages()

    @property
    def size(self) -> int:
        """Bytes of the file."""
        return self._path.stat().st_size if self._writer is None else self._writer.size

    def read_messages(
        self,
        topics: str | list[str] | None = None,
        start_time: Any = None,
        end_time: Any = None,
        connection_filter: Callable[..., bool] | None = None,
        raw: bool = False,
        return_connection_header: bool = False,
    ) -> Iterator[Any]:
        """Yield topic, message and time of messages by time.

        Args:
            topics: one, several, all when None.
            start_time: first time, a `rospy.Time`.
            end_time: last time.
            connection_filter: takes topic, type, MD5 sum, definition and header.
            raw: give (type, bytes, MD5 sum, place, class) for the message.
            return_connection_header: give the connection's header too.

        Raises:
            ValueError: the bag is closed.
            ROSBagException: it is damaged.
        """
        reader = self._for_reading()
        wanted = self._chooser(topics, connection_filter)
        start_ns = None if start_time is None else int(start_time.to_nsec())
        end_ns = None if end_time is None else int(end_time.to_nsec())
        make, readers = _raw_reader if raw else _reader, dict[int, Callable[[bytes], Any]]()
        for connection, stamp_ns, data in reader.messages(wanted, start_ns, end_ns):
            if connection.id not in readers:
                readers[connection.id] = make(connection, self._types)
            message = readers[connection.id](data)
            stamp = Time(nsecs=stamp_ns)
            if return_connection_header:
                header = _header(connection)
                yield BagMessageWithConnectionHeader(connection.topic, message, stamp, header)
            else:
                yield BagMessage(connection.topic, message, stamp)

    def write(
        self,
        topic: str,
        msg: Any,
        t: Any = None,
        raw: bool = False,
        connection_header: dict[str, Any] | None = None,
    ) -> None:
        """Write a message.

        Args:
            topic: its topic.
            msg: the message, or what ``raw`` reading gives.
            t: when it was received; now, of the node's clock, when None.
            raw: see `msg`.
            connection_header: tells of its publisher: ``callerid``, ``latching``.

        Raises:
            ValueError: the bag is closed, or nothing was given to write.
            ROSBagException: it is open for reading.
        """
        self._check_open()
        if self._writer is None:
            raise ROSBagException(f"{self.filename} is open for reading, not for writing")
        if not topic or not msg:
            raise ValueError("topic is invalid" if not topic else "msg is invalid")
        stamp_ns = _now_ns() if t is None else int(t.to_nsec())
        name, data = (msg[0], bytes(msg[1])) if raw else (_name_of(msg), to_ros1(_as_ros1(msg)))
        types = types_of(msg[4] if raw and len(msg) > 4 else msg)
        header = {key: _text(value) for key, value in (connection_header or {}).items()}
        connection = self._connection(topic, name, header, types)
        self._writer.write(connection, stamp_ns, data)

    def flush(self) -> None:
        """Hand what was written to the system."""
        if self._writer is not None:
            self._writer.flush()

    def reindex(self) -> Iterator[int]:
        """Yield the bag's size: there is nothing to do, bags without index are read."""
        yield self.size

    def close(self) -> None:
        """Close the bag; twice does nothing."""
        if self._closed:
            return
        self._closed = True
        for one in (self._reader, self._writer):
            if one is not None:
                one.close()

    def get_message_count(self, topic_filters: str | list[str] | None = None) -> int:
        """Return the number of messages, of some topics if named."""
        return sum(row.message_count for row in self._topics(topic_filters).values())

    def get_start_time(self) -> float:
        """Return the time of the first message in seconds.

        Raises:
            ROSBagException: there is none.
        """
        return self._summary_ns("start_ns") / _NANO

    def get_end_time(self) -> float:
        """Return the time of the last message in seconds.

        Raises:
            ROSBagException: there is none.
        """
        return self._summary_ns("end_ns") / _NANO

    def get_compression_info(self) -> CompressionTuple:
        """Return the compression that most chunks have, and bytes before and after."""
        packs = self._for_reading().summary.packs
        most = max(packs, key=lambda name: packs[name].pieces, default="none")
        before = sum(one.uncompressed for one in packs.values())
        return CompressionTuple(most, before, sum(one.compressed for one in packs.values()))

    def get_type_and_topic_info(
        self, topic_filters: str | list[str] | None = None
    ) -> TypesAndTopicsTuple:
        """Return all types, and topics with counts and frequencies."""
        types = {
            ros1_name_of(one): one.md5sum or self._types.md5sum(ros1_name_of(one))
            for one in self._for_reading().connections
        }
        return TypesAndTopicsTuple(types, self._topics(topic_filters))

    def __str__(self) -> str:
        if self._reader is None:
            return f"path:        {self.filename} (being written)"
        rows = [f"path:        {self.filename}", f"messages:    {self.get_message_count()}"]
        for name, row in self._topics(None).items():
            rows.append(f"topic:       {name}   {row.message_count} msgs : {row.msg_type}")
        return "\n".join(rows)

    def _topics(self, chosen: str | list[str] | None) -> dict[str, TopicTuple]:
        reader = self._for_reading()
        wanted = self._chooser(chosen, None) or (lambda _connection: True)
        stamps: dict[str, list[int]] = {}
        for row in reader.messages(wanted):
            stamps.setdefault(row.connection.topic, []).append(row.stamp_ns)
        found: dict[str, TopicTuple] = {}
        for one in sorted(filter(wanted, reader.connections), key=lambda item: item.topic):
            times = stamps.get(one.topic, [])
            ends = sum(other.topic == one.topic for other in reader.connections)
            found[one.topic] = TopicTuple(ros1_name_of(one), len(times), ends, _frequency(times))
        return found

    def _chooser(
        self, topics: str | list[str] | None, judge: Callable[..., bool] | None
    ) -> Callable[[Connection], bool] | None:
        names = None if topics is None else {topics} if isinstance(topics, str) else set(topics)
        known = [one.topic for one in self._for_reading().connections]
        for name in sorted((names or set()) - set(known)):
            # The real one gives nothing without a word.
            hint = did_you_mean(name, known)
            sys.stderr.write(f"{self.filename} has no messages of topic '{name}'; {hint}\n")

        def wanted(one: Connection) -> bool:
            if names is not None and one.topic not in names:
                return False
            row = (one.topic, ros1_name_of(one), one.md5sum, one.definition, _header(one))
            return judge is None or bool(judge(*row))

        return wanted

    def _summary_ns(self, name: str) -> int:
        summary = self._for_reading().summary
        if not summary.messages:
            raise ROSBagException("Bag contains no message")
        return int(getattr(summary, name))

    def _connection(
        self, topic: str, name: str, header: dict[str, str], types: TypeStore
    ) -> Connection:
        assert self._writer is not None
        key = (topic, name, header.get("callerid", ""))
        if key not in self._known:
            made = ros1_connection(
                topic, name, callerid=key[2], latching=header.get("latching") == "1", types=types
            )
            self._known[key] = self._writer.add(made)
        return self._known[key]

    def _open_reader(self) -> None:
        if not self._path.exists():
            raise FileNotFoundError(2, "No such file or directory", self.filename)
        try:
            self._reader = open_bag(self._path)
            self._types, differing = bag_types(self._reader.connections)
        except BagError as error:
            raise ROSBagFormatException(str(error)) from error
        for name in differing:
            sys.stderr.write(f"{self.filename} has another definition of {name}; it counts here\n")

    def _open_writer(self, mode: str, compression: str, chunk_bytes: int) -> None:
        append = mode == "a" and self._path.exists() and self._path.stat().st_size > 0
        options = {"compression": Packing(compression), "chunk_bytes": chunk_bytes}
        try:
            writer = Ros1Writer(self._path, append=append, **options)  # type: ignore[arg-type]
            self._types = bag_types(writer.connections).store
        except BagError as error:
            raise ROSBagException(str(error)) from error
        self._writer = writer
        for one in writer.connections:
            self._known[one.topic, one.type_name, one.callerid] = one

    def _for_reading(self) -> BagReader:
        self._check_open()
        if self._reader is None:
            raise ROSBagException(f"{self.filename} is open for writing, not for reading")
        return self._reader

    def _check_open(self) -> None:
        if self._closed:
            raise ValueError("I/O operation on closed bag")


def _reader(connection: Connection, types: TypeStore) -> Callable[[bytes], Any]:
    view: Any = types.ros1_message_type(ros1_name_of(connection))
    convert = converter(connection, Encoding.ROS1, types)
    return lambda data: from_ros1(view, convert(data))


def _raw_reader(connection: Connection, types: TypeStore) -> Callable[[bytes], Any]:
    name = ros1_name_of(connection)
    view, digest = types.ros1_message_type(name), connection.md5sum or types.md5sum(name)
    convert = converter(connection, Encoding.ROS1, types)
    return lambda data: (name, convert(data), digest, (0, 0), view)


def _header(connection: Connection) -> dict[str, bytes]:
    header = {
        "topic": connection.topic,
        "type": ros1_name_of(connection),
        "md5sum": connection.md5sum,
        "message_definition": connection.definition,
    }
    if connection.callerid:
        header |= {"callerid": connection.callerid, "latching": "01"[connection.latching]}
    return {name: value.encode() for name, value in header.items()}


def _name_of(message: Any) -> str:
    return str(_as_ros1(message)._type)


def _as_ros1(message: Any) -> Any:
    if not hasattr(message, "_slot_types"):
        text = f"{type(message).__name__} is no message of ROS 1"
        raise ROSBagException(f"{text}\n  fix: write messages of rospy, or use rosbag2_py")
    return message


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _frequency(stamps: list[int]) -> float | None:
    gaps = [after - before for before, after in pairwise(stamps)]
    middle = statistics.median(gaps) if gaps else 0
    return _NANO / middle if middle > 0 else None


def _now_ns() -> int:
    from gazelle.compat.rospy.rostime import get_rostime
    from gazelle.compat.rospy.state import STATE

    if STATE.node is None:
        import time

        return time.time_ns()
    return int(get_rostime().to_nsec())
