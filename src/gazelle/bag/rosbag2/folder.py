"""A bag of rosbag2: a folder of files that continue each other."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from gazelle.bag.formats import (
    OWN_FORMATS,
    Packing,
    StorageFormat,
    check_compression,
    folder_formats,
    format_of_name,
    format_of_suffix,
    problems_of_added,
)
from gazelle.bag.rosbag2.compression_modes import SUFFIX, CompressedFile, CompressedMessages
from gazelle.bag.rosbag2.metadata import FileSummary, read_metadata, write_metadata
from gazelle.bag.storage import (
    BagError,
    BagMessage,
    BagReader,
    BagWriter,
    Connection,
    Encoding,
    Pack,
    Summary,
    Wanted,
)
from gazelle.documents.files import is_file
from gazelle.rich_display import shown_by

__all__ = ["Rosbag2", "Rosbag2Writer", "reindex"]


@shown_by("bags:bag_bundle")
class Rosbag2:
    """An open folder; topics of its files that are the same are one connection.

    Attributes:
        path: the folder.
        files: its files.
        has_metadata: it was closed properly.
    """

    def __init__(self, path: Path) -> None:
        """Open a folder.

        Raises:
            BagError: it is no bag, or one of its files cannot be read.
        """
        self.path = path
        metadata = read_metadata(path)
        self.has_metadata = metadata is not None
        mode = metadata.compression_mode if metadata is not None else ""
        if metadata is not None and mode not in ("", "none"):
            _check_format(path, mode, metadata.compression_format)
        self.files = _files(path, metadata.files if metadata else ())
        self._readers: list[BagReader] = [_open(file) for file in self.files]
        if mode == "message":
            self._readers = [CompressedMessages(one) for one in self._readers]
        self.storage = self._readers[0].storage
        self.ros_distro = metadata.ros_distro if metadata else ""
        self._own: dict[tuple[int, int], Connection] = {}
        self._connections = self._merged()

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All topics, by number."""
        return tuple(self._connections)

    @property
    def summary(self) -> Summary:
        """What is in it."""
        counts: dict[int, int] = {}
        packs: dict[str, Pack] = {}
        parts = [one.summary for one in self._readers]
        for index, part in enumerate(parts):
            for number, count in part.counts.items():
                own = self._own[index, number].id
                counts[own] = counts.get(own, 0) + count
            packs |= part.packs
        filled = [one for one in parts if one.messages]
        return Summary(
            counts,
            min((one.start_ns for one in filled), default=0),
            max((one.end_ns for one in filled), default=0),
            sum(one.size for one in parts),
            packs,
            self.has_metadata and all(one.is_indexed for one in parts),
            sum(one.lost for one in parts),
        )

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` topics between two stamps."""
        streams = [
            self._of_file(file_number, wanted, start_ns, end_ns)
            for file_number in range(len(self._readers))
        ]
        return heapq.merge(*streams, key=lambda message: message.stamp_ns)

    def close(self) -> None:
        """Close the files."""
        for one in self._readers:
            one.close()

    def _of_file(
        self, file_number: int, wanted: Wanted | None, start_ns: int | None, end_ns: int | None
    ) -> Iterator[BagMessage]:
        for message in self._readers[file_number].messages(wanted, start_ns, end_ns):
            yield message._replace(connection=self._own[file_number, message.connection.id])

    def _merged(self) -> list[Connection]:
        found: dict[tuple[str, str], Connection] = {}
        for file_number, reader in enumerate(self._readers):
            for one in reader.connections:
                key = (one.topic, one.type_name)
                own = found.setdefault(key, replace(one, id=len(found) + 1))
                self._own[file_number, one.id] = own
        return list(found.values())


class Rosbag2Writer:
    """Writes a folder: files ``NAME_0.mcap``, ``NAME_1.mcap`` … and ``metadata.yaml``.

    Attributes:
        path: the folder.
        storage: of the files.
    """

    encoding = Encoding.CDR

    def __init__(
        self, path: Path, storage: str, *, compression: str = "", overwrite: bool = False
    ) -> None:
        """Create the folder.

        Raises:
            BagError: it is there already, or the file system refuses it, or there is no such
                storage or compression.
        """
        self.path = path
        self._format = format_of_name(storage)
        self.storage = self._format.name
        check_compression(self._format, compression)
        self._packing = Packing(compression.removeprefix("none"))
        try:
            path.mkdir(parents=True, exist_ok=overwrite)
        except FileExistsError:
            raise BagError(f"Output folder '{path}' already exists.") from None
        except OSError as error:
            raise BagError(f"Error opening file: {path}: {error.strerror}") from None
        self._connections: list[Connection] = []
        self._own: dict[int, Connection] = {}
        self._done: list[FileSummary] = []
        self._counts: dict[int, int] = {}
        self._file_counts: dict[int, int] = {}
        self._span: tuple[int, int] | None = None
        self._written = 0
        self._closed = False
        self._file = self._next_file()

    @property
    def size(self) -> int:
        """Bytes of the file that is being written."""
        return self._file.size

    @property
    def file(self) -> Path:
        """The file that is being written."""
        return self._file.path

    @property
    def restored(self) -> int:
        """How often the file was written anew because somebody had removed it."""
        return self._file.restored

    def add(self, connection: Connection) -> Connection:
        """Add a topic; returns it with its number in this bag."""
        own = replace(connection, id=len(self._connections))
        self._connections.append(own)
        self._own[own.id] = self._file.add(own)
        return own

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message."""
        number = connection.id
        self._file.write(self._own[number], stamp_ns, data)
        self._counts[number] = self._counts.get(number, 0) + 1
        self._file_counts[number] = self._file_counts.get(number, 0) + 1
        low, high = self._span or (stamp_ns, stamp_ns)
        self._span = (min(low, stamp_ns), max(high, stamp_ns))

    def flush(self) -> None:
        """Hand everything to the system."""
        self._file.flush()

    def split(self, stamp_ns: int = 0) -> Path:
        """Go on in a new file; returns the one that is finished."""
        del stamp_ns  # nothing is repeated in the new file
        done = self._file.path
        self._finish_file()
        self._file = self._next_file()
        self._own = {one.id: self._file.add(one) for one in self._connections}
        return done

    def close(self) -> None:
        """Finish the last file and write ``metadata.yaml``; calling it twice does nothing."""
        if self._closed:
            return
        self._closed = True
        self._finish_file()
        counts = [(one, self._counts.get(one.id, 0)) for one in self._connections]
        write_metadata(self.path, self.storage, counts, self._done)

    def _next_file(self) -> BagWriter:
        name = f"{self.path.name}_{len(self._done)}{self._format.suffix}"
        return self._format.create(self.path / name, self._packing)

    def _finish_file(self) -> None:
        self._file.close()
        path, (start_ns, end_ns) = self._file.path, self._span or (0, 0)
        summary = Summary(self._file_counts, start_ns, end_ns, path.stat().st_size)
        self._done.append(FileSummary(path, summary))
        self._file_counts, self._span = {}, None


def reindex(folder: Path) -> None:
    """Write a folder's ``metadata.yaml`` from its files.

    Raises:
        BagError: there are no files, or one cannot be read.
    """
    files = _files(folder, ())
    readers = [_open(file) for file in files]
    counts: dict[str, tuple[Connection, int]] = {}
    parts = []
    for reader in readers:
        summary = reader.summary
        parts.append(FileSummary(reader.path, summary))
        for one in reader.connections:
            before = counts.get(one.topic, (one, 0))[1]
            counts[one.topic] = (one, before + summary.counts.get(one.id, 0))
        reader.close()
    write_metadata(folder, readers[0].storage, list(counts.values()), parts)


def _open(path: Path) -> BagReader:
    if path.suffix == SUFFIX:
        return CompressedFile(path, _open)
    found = format_of_suffix(path.suffix)
    if found is None or not found.in_folder:
        suffixes = " or ".join(one.suffix for one in folder_formats())
        text = f"{path}: a file of rosbag2 ends in {suffixes}, or in these and {SUFFIX}"
        raise BagError("; ".join((text, *problems_of_added())))
    return found.open(path)


def _check_format(path: Path, mode: str, name: str) -> None:
    if name != "zstd" or mode not in ("file", "message"):
        text = f"{path}: its {mode}s are compressed with {name or 'an unknown method'}"
        hint = "`ros2 bag convert` of ROS 2 writes it without"
        raise BagError(f"{text}, which is not read here (only zstd is); {hint}")


def _files(folder: Path, names: tuple[str, ...]) -> tuple[Path, ...]:
    files = [folder / Path(name).name for name in names]
    if not files:
        files = _files_of(folder, OWN_FORMATS) or _files_of(folder, folder_formats())
    if not files:
        suffixes = " and ".join(f"no {one.suffix}" for one in folder_formats())
        text = f"{folder}: there is no bag in this folder ({suffixes})"
        raise BagError("; ".join((text, *problems_of_added())))
    for file in files:
        if not is_file(file):
            raise BagError(f"{folder}: its metadata.yaml names {file.name}, which is not there")
    return tuple(files)


def _files_of(folder: Path, formats: tuple[StorageFormat, ...]) -> list[Path]:
    suffixes = {one.suffix for one in formats if one.in_folder}
    files = [one for one in folder.iterdir() if _bare(one).suffix in suffixes]
    return sorted(files, key=_place)


def _bare(path: Path) -> Path:
    return path.with_suffix("") if path.suffix == SUFFIX else path


def _place(path: Path) -> tuple[int, str]:
    number = _bare(path).stem.rpartition("_")[2]
    return (int(number) if number.isdigit() else 0, path.name)
