"""What every format of bag holds: connections, messages, and a summary of both."""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, Protocol

from gazelle.errors import GazelleError
from gazelle.rich_display import shown_by

__all__ = [
    "BagError",
    "BagMessage",
    "BagReader",
    "BagWriter",
    "Connection",
    "Encoding",
    "Pack",
    "Storage",
    "Summary",
    "Wanted",
    "counts_of",
    "packs_of",
]


class BagError(GazelleError):
    """A bag cannot be read or written; the text says which and why."""


class Encoding(enum.StrEnum):
    """How the bytes of a message are written."""

    ROS1 = "ros1"
    CDR = "cdr"


class Storage(enum.StrEnum):
    """The names of ROS's own formats, as rosbag2 gives them; all are in `gazelle.bag.formats`."""

    ROS1 = "rosbag"
    MCAP = "mcap"
    SQLITE = "sqlite3"


@dataclass(frozen=True, slots=True)
class Connection:
    """One publisher's part of a topic (ROS 1), or a topic (rosbag2).

    Attributes:
        id: number in the bag.
        topic: global name.
        type_name: ``pkg/Name`` in a ROS 1 bag, ``pkg/msg/Name`` in others.
        encoding: how the messages are written.
        definition: text of the type and of all it contains.
        md5sum: ROS 1's sum of the type, empty elsewhere.
        callerid: node that published, where it is known.
        latching: late subscriptions get the last message.
        qos: rosbag2's ``offered_qos_profiles``, YAML; empty where it is not known.
        type_hash: RIHS01 hash of the type, empty where it is not known.
    """

    id: int
    topic: str
    type_name: str
    encoding: Encoding
    definition: str = ""
    md5sum: str = ""
    callerid: str = ""
    latching: bool = False
    qos: str = ""
    type_hash: str = ""


@shown_by("bags:bag_message_bundle")
class BagMessage(NamedTuple):
    """One message as it lies in the bag; `stamp_ns` is when it was received, since 1970."""

    connection: Connection
    stamp_ns: int
    data: bytes


class Pack(NamedTuple):
    """How many pieces of a bag are compressed in one way, and their bytes before and after."""

    pieces: int
    uncompressed: int
    compressed: int


@dataclass(frozen=True, slots=True)
class Summary:
    """What is in a bag.

    Attributes:
        counts: messages by the connection's number.
        start_ns, end_ns: stamps of the first and the last message; 0 without messages.
        size: bytes of the file, or of all files.
        packs: by the name of the compression.
        is_indexed: the file was closed properly. One that was not is read all the same.
        lost: bytes at the end that hold no whole piece, of a writer that was killed.
    """

    counts: dict[int, int] = field(default_factory=dict)
    start_ns: int = 0
    end_ns: int = 0
    size: int = 0
    packs: dict[str, Pack] = field(default_factory=dict)
    is_indexed: bool = True
    lost: int = 0

    @property
    def messages(self) -> int:
        """Number of all messages."""
        return sum(self.counts.values())

    @property
    def duration_ns(self) -> int:
        """Time between the first and the last message."""
        return self.end_ns - self.start_ns


class _Chunk(Protocol):
    compression: str
    size: int
    uncompressed: int
    counts: dict[int, int]


def counts_of(chunks: Iterable[_Chunk]) -> dict[int, int]:
    """Return how many messages of each connection a file's chunks hold."""
    counts: dict[int, int] = {}
    for chunk in chunks:
        for number, count in chunk.counts.items():
            counts[number] = counts.get(number, 0) + count
    return counts


def packs_of(chunks: Iterable[_Chunk]) -> dict[str, Pack]:
    """Return how much of a file's chunks is compressed in which way, by its name."""
    packs: dict[str, Pack] = {}
    for chunk in chunks:
        before = packs.get(chunk.compression, Pack(0, 0, 0))
        packs[chunk.compression] = Pack(
            before.pieces + 1,
            before.uncompressed + chunk.uncompressed,
            before.compressed + chunk.size,
        )
    return packs


Wanted = Callable[[Connection], bool]


class BagReader(Protocol):
    """An open bag; `storage` is the name of its format."""

    path: Path
    storage: str

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All connections, by number."""
        ...

    @property
    def summary(self) -> Summary:
        """What is in it."""
        ...

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` connections between two stamps."""
        ...

    def close(self) -> None:
        """Close the file."""
        ...


class BagWriter(Protocol):
    """A bag that is being written; `storage` is the name of its format."""

    path: Path
    storage: str
    encoding: Encoding

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait included."""
        ...

    @property
    def restored(self) -> int:
        """How often the file was written anew because somebody had removed it."""
        ...

    def add(self, connection: Connection) -> Connection:
        """Add a connection; returns it with its number in this bag."""
        ...

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message."""
        ...

    def flush(self) -> None:
        """Hand everything to the system, so that it survives the end of this process."""
        ...

    def close(self) -> None:
        """Finish the file."""
        ...
