"""rosbag2_py: readers and writers of rosbag2; reads ROS 1 bags as well."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.bag import (
    BagError,
    BagMessage,
    BagReader,
    BagWriter,
    Connection,
    Encoding,
    cdr_connection,
    converter,
    create_bag,
    learn_definitions,
    open_bag,
    wire_name_of,
)
from gazelle.bag.formats import MCAP, SQLITE, folder_formats
from gazelle.bag.rosbag2.folder import reindex
from gazelle.compat.rclpy.duration import Duration
from gazelle.compat.rclpy.time import Time
from gazelle.diagnostics import did_you_mean

__all__ = [
    "BagMetadata",
    "ConverterOptions",
    "FileInformation",
    "Info",
    "Reindexer",
    "SequentialReader",
    "SequentialWriter",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "get_default_storage_id",
    "get_registered_compressors",
    "get_registered_readers",
    "get_registered_serializers",
    "get_registered_writers",
]

_SQLITE_DISTROS = ("dashing", "eloquent", "foxy", "galactic", "humble")


@dataclass
class StorageOptions:
    """Where a bag is, and how it is stored; limits of size and time split nothing here."""

    uri: str = ""
    storage_id: str = ""
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ""
    storage_config_uri: str = ""
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class ConverterOptions:
    """How messages are written: ``cdr``, the only format here; another one is refused."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""

    def check(self) -> None:
        """See that nothing would have to be converted.

        Raises:
            RuntimeError: a format is not ``cdr``.
        """
        for name in (self.input_serialization_format, self.output_serialization_format):
            if name not in ("", "cdr"):
                text = f"Could not find converter for format {name}"
                raise RuntimeError(f"{text}; messages of a bag are cdr here")


class TopicMetadata:
    """A topic of a bag; ``id`` is a first argument only since Iron."""

    def __init__(self, *args: Any, **fields: Any) -> None:
        names = ["name", "type", "serialization_format", "offered_qos_profiles"]
        if args and isinstance(args[0], int):
            names.insert(0, "id")
        given = dict(zip(names, args, strict=False)) | fields
        self.id = int(given.get("id", 0))
        self.name = str(given.get("name", ""))
        self.type = str(given.get("type", ""))
        self.serialization_format = str(given.get("serialization_format", "cdr"))
        self.offered_qos_profiles: Any = given.get("offered_qos_profiles", "")
        self.type_description_hash = str(given.get("type_description_hash", ""))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TopicMetadata) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"TopicMetadata(name={self.name!r}, type={self.type!r})"


@dataclass
class StorageFilter:
    """Which topics are read; all when empty."""

    topics: list[str] = field(default_factory=list)
    topics_regex: str = ""


@dataclass(frozen=True)
class TopicInformation:
    """A topic and its number of messages."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass(frozen=True)
class FileInformation:
    """A file of a bag."""

    path: str
    starting_time: Time
    duration: Duration
    message_count: int


@dataclass(frozen=True)
class BagMetadata:
    """What is in a bag."""

    version: int
    bag_size: int
    storage_identifier: str
    relative_file_paths: list[str]
    files: list[FileInformation]
    duration: Duration
    starting_time: Time
    message_count: int
    topics_with_message_count: list[TopicInformation]
    compression_format: str = ""
    compression_mode: str = ""


class SequentialReader:
    """Reads the messages of a bag by time."""

    def __init__(self) -> None:
        self._reader: BagReader | None = None
        self._uri = ""
        self._filter = StorageFilter()
        self._start_ns = 0
        self._rows: Iterator[BagMessage] = iter(())
        self._next: BagMessage | None = None

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """Open a bag.

        Raises:
            RuntimeError: it is not there, cannot be read, or is to be converted.
        """
        (converter_options or ConverterOptions()).check()
        self.open_uri(storage_options.uri)

    def open_uri(self, uri: str) -> None:
        """Open a bag by its path.

        Raises:
            RuntimeError: it is not there or cannot be read.
        """
        try:
            self._reader = open_bag(uri)
            # It hands out bytes and names only: whoever reads them asks the process for the type.
            learn_definitions(self._reader.connections)
        except BagError as error:
            text = f"No storage could be initialized from the inputs.\n  {error}"
            raise RuntimeError(text) from error
        self._uri = uri
        self._begin()

    def close(self) -> None:
        """Close the bag."""
        if self._reader is not None:
            self._reader.close()
            self._reader = None

    def has_next(self) -> bool:
        """Tell whether there is another message."""
        self._opened()
        return self._next is not None

    def read_next(self) -> tuple[str, bytes, int]:
        """Return topic, bytes (CDR) and nanoseconds of the next message.

        Raises:
            RuntimeError: there is none.
        """
        self._opened()
        row = self._next
        if row is None:
            raise RuntimeError("Bag is at end. No next message.")
        self._next = next(self._rows, None)
        data = converter(row.connection, Encoding.CDR)(row.data)
        return row.connection.topic, data, row.stamp_ns

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Return all topics."""
        return [_topic(one) for one in self._opened().connections]

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Read some topics only, from here on."""
        known = [one.topic for one in self._opened().connections]
        for name in storage_filter.topics:
            if name not in known:
                text = f"{self._uri} has no topic '{name}'; {did_you_mean(name, known)}"
                raise RuntimeError(text)
        self._filter = dataclasses.replace(storage_filter)
        self._begin()

    def reset_filter(self) -> None:
        """Read all topics, from here on."""
        self._filter = StorageFilter()
        self._begin()

    def seek(self, timestamp: int | Time) -> None:
        """Go on with the first message from a time on."""
        self._start_ns = _ns(timestamp)
        self._begin()

    def get_metadata(self) -> BagMetadata:
        """Return what is in the bag."""
        return _metadata(self._opened(), Path(self._uri))

    def _begin(self) -> None:
        import re

        chosen = self._filter
        pattern = re.compile(chosen.topics_regex) if chosen.topics_regex else None

        def wanted(one: Connection) -> bool:
            if not chosen.topics and pattern is None:
                return True
            return one.topic in chosen.topics or bool(pattern and pattern.fullmatch(one.topic))

        # What was read already stays read when only the filter changes.
        start_ns = self._next.stamp_ns if self._next is not None else 0
        start_ns = self._start_ns or start_ns
        self._start_ns = 0
        self._rows = self._opened().messages(wanted, start_ns or None)
        self._next = next(self._rows, None)

    def _opened(self) -> BagReader:
        if self._reader is None:
            raise RuntimeError("Bag is not open. Call open() before reading.")
        return self._reader


class SequentialWriter:
    """Writes a bag."""

    def __init__(self) -> None:
        self._writer: BagWriter | None = None
        self._connections: dict[str, Connection] = {}

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """Create a bag: a folder with ``metadata.yaml``.

        Raises:
            RuntimeError: there is one already, it is to be converted, or the storage is not known.
        """
        (converter_options or ConverterOptions()).check()
        name = storage_options.storage_id or get_default_storage_id()
        if name not in (known := _storages()):
            text = f"No storage could be initialized: '{name}' is not known"
            raise RuntimeError(f"{text}; {did_you_mean(name, known)}")
        folder = Path(storage_options.uri)
        if folder.exists():
            text = f"Bag directory already exists ({folder}), can't overwrite existing bag"
            raise RuntimeError(text)
        try:
            self._writer = create_bag(folder, name)
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def create_topic(self, topic: TopicMetadata) -> None:
        """Add a topic.

        Raises:
            RuntimeError: the bag is not open, or messages are not to be written as CDR.
        """
        if topic.serialization_format not in ("", "cdr"):
            text = f"topic {topic.name} has serialization format {topic.serialization_format}"
            raise RuntimeError(f"{text}; this writer writes cdr")
        qos = topic.offered_qos_profiles
        made = cdr_connection(topic.name, topic.type, qos=qos if isinstance(qos, str) else "")
        self._connections.setdefault(topic.name, self._opened().add(made))

    def write(self, topic_name: str, message: bytes, timestamp: int | Time) -> None:
        """Write a message's bytes (CDR), received at a time in nanoseconds.

        Raises:
            RuntimeError: the topic was not created.
        """
        writer = self._opened()
        if topic_name not in self._connections:
            text = (
                f"Failed to write on topic '{topic_name}'. Call create_topic() before first write."
            )
            hint = did_you_mean(topic_name, self._connections)
            raise RuntimeError(f"{text} {hint}".rstrip())
        writer.write(self._connections[topic_name], _ns(timestamp), bytes(message))

    def close(self) -> None:
        """Finish the bag; twice does nothing."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None

    def __del__(self) -> None:
        # The original has no close() before Iron: its end of life finishes the bag.
        self.close()

    def _opened(self) -> BagWriter:
        if self._writer is None:
            raise RuntimeError("Bag is not open. Call open() before writing.")
        return self._writer


class Info:
    """Reads what is in a bag."""

    def read_metadata(self, uri: str, storage_id: str = "") -> BagMetadata:
        """Return what is in a bag.

        Raises:
            RuntimeError: it is not there or cannot be read.
        """
        reader = SequentialReader()
        reader.open(StorageOptions(uri, storage_id))
        found = reader.get_metadata()
        reader.close()
        return found


class Reindexer:
    """Writes ``metadata.yaml`` anew."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """Write it for the files that are there.

        Raises:
            RuntimeError: there are none.
        """
        try:
            reindex(Path(storage_options.uri))
        except BagError as error:
            raise RuntimeError(str(error)) from error


def get_default_storage_id() -> str:
    """Return the storage of bags that name none: ``sqlite3`` up to Humble, ``mcap`` since."""
    return (SQLITE if os.environ.get("ROS_DISTRO", "") in _SQLITE_DISTROS else MCAP).name


def _storages() -> tuple[str, ...]:
    return tuple(one.name for one in folder_formats())


def get_registered_readers() -> set[str]:
    """Return the storages that can be read."""
    return set(_storages())


def get_registered_writers() -> set[str]:
    """Return the storages that can be written."""
    return set(_storages())


def get_registered_compressors() -> set[str]:
    """Return the compressions of whole messages and files: none."""
    return set()


def get_registered_serializers() -> set[str]:
    """Return how messages are written."""
    return {"cdr"}


def _ns(stamp: int | Time) -> int:
    return stamp.nanoseconds if isinstance(stamp, Time) else int(stamp)


def _topic(one: Connection) -> TopicMetadata:
    return TopicMetadata(
        id=one.id,
        name=one.topic,
        type=wire_name_of(one),
        offered_qos_profiles=one.qos,
        type_description_hash=one.type_hash,
    )


def _metadata(reader: BagReader, path: Path) -> BagMetadata:
    summary = reader.summary
    start = Time(nanoseconds=summary.start_ns)
    duration = Duration(nanoseconds=summary.duration_ns)
    files = sorted(one.name for one in path.iterdir()) if path.is_dir() else [path.name]
    names = [name for name in files if not name.endswith(".yaml")]
    return BagMetadata(
        version=9,
        bag_size=summary.size,
        storage_identifier=str(reader.storage),
        relative_file_paths=names,
        files=[FileInformation(name, start, duration, summary.messages) for name in names[:1]],
        duration=duration,
        starting_time=start,
        message_count=summary.messages,
        topics_with_message_count=[
            TopicInformation(_topic(one), summary.counts.get(one.id, 0))
            for one in reader.connections
        ],
    )
