"""The formats of bag files, in one table: their names, suffixes, first bytes, readers and writers.

Everything that tells formats apart asks here. Pip packages add formats by the entry points
``gazelle.bag_storage``; those are looked at where none of the table fits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from gazelle.bag.db3 import SQLITE_MAGIC, SqliteBag, SqliteWriter
from gazelle.bag.mcap import McapBag, McapWriter
from gazelle.bag.mcap.records import MAGIC as MCAP_MAGIC
from gazelle.bag.ros1 import Compression, Ros1Bag, Ros1Writer
from gazelle.bag.ros1.records import MAGIC as ROS1_MAGIC
from gazelle.bag.storage import BagError, BagReader, BagWriter, Encoding, Storage
from gazelle.diagnostics import did_you_mean
from gazelle.extensions import ExtensionGroup, entry_points_of, load_extensions

__all__ = [
    "MCAP",
    "OWN_FORMATS",
    "ROS1",
    "SQLITE",
    "UNFINISHED",
    "Packing",
    "StorageFormat",
    "check_compression",
    "folder_formats",
    "format_of_name",
    "format_of_start",
    "format_of_suffix",
    "problems_of_added",
    "storage_names",
]

UNFINISHED = ".active"
"""Behind the suffix of a bag of ROS 1 while it is recorded."""


class Packing(NamedTuple):
    """How a file is written.

    Attributes:
        compression: one of the format's, empty for none.
        chunk_bytes: when a chunk is full; the format's own size when None.
    """

    compression: str = ""
    chunk_bytes: int | None = None


@dataclass(frozen=True, slots=True)
class StorageFormat:
    """A format of bag files.

    Attributes:
        name: as ``metadata.yaml``, ``--storage`` and ``storage`` of readers and writers have it;
            also the name of the entry point, where a package adds it.
        suffix: of its files, with the dot.
        encoding: of the messages in them.
        magic: with what its files begin; empty where only the suffix tells.
        open: opens a file.
        create: creates a file, over one that is there.
        compressions: that its writer knows, besides none.
        in_folder: whether a bag is rosbag2's folder of such files; else each file is a bag.
        reindex: the command that writes the index of a bag that was not closed.
    """

    name: str
    suffix: str
    encoding: Encoding
    magic: bytes
    open: Callable[[Path], BagReader]
    create: Callable[[Path, Packing], BagWriter]
    compressions: tuple[str, ...] = ()
    in_folder: bool = True
    reindex: str = "ros2 bag reindex"


def _create_ros1(path: Path, packing: Packing) -> BagWriter:
    compression = Compression(packing.compression or "none")
    if packing.chunk_bytes is None:
        return Ros1Writer(path, compression=compression)
    return Ros1Writer(path, compression=compression, chunk_bytes=packing.chunk_bytes)


def _create_mcap(path: Path, packing: Packing) -> BagWriter:
    if packing.chunk_bytes is None:
        return McapWriter(path, compression=packing.compression)
    return McapWriter(path, compression=packing.compression, chunk_bytes=packing.chunk_bytes)


def _create_sqlite(path: Path, _packing: Packing) -> BagWriter:
    return SqliteWriter(path)


ROS1 = StorageFormat(
    Storage.ROS1, ".bag", Encoding.ROS1, ROS1_MAGIC, Ros1Bag, _create_ros1,
    ("bz2", "lz4"), in_folder=False, reindex="rosbag reindex",
)  # fmt: skip
MCAP = StorageFormat(
    Storage.MCAP, ".mcap", Encoding.CDR, MCAP_MAGIC, McapBag, _create_mcap, ("lz4", "zstd")
)
SQLITE = StorageFormat(
    Storage.SQLITE, ".db3", Encoding.CDR, SQLITE_MAGIC, SqliteBag, _create_sqlite
)
OWN_FORMATS = (ROS1, MCAP, SQLITE)
"""Those that Gazelle itself brings."""


def storage_names() -> tuple[str, ...]:
    """Return the names of all formats; nothing of other packages is imported for that."""
    added = (point.name for point in entry_points_of(ExtensionGroup.BAG_STORAGE))
    return tuple(dict.fromkeys([*(one.name for one in OWN_FORMATS), *added]))


def folder_formats() -> tuple[StorageFormat, ...]:
    """Return the formats that rosbag2's folders can hold."""
    return tuple(one for one in (*OWN_FORMATS, *_added()) if one.in_folder)


def problems_of_added() -> tuple[str, ...]:
    """Return one sentence for each format of another package that cannot be loaded."""
    return load_extensions(ExtensionGroup.BAG_STORAGE, StorageFormat).problems


def format_of_name(name: str) -> StorageFormat:
    """Return the format of a name.

    Raises:
        BagError: there is none; says which there are, and which cannot be loaded.
    """
    known = {one.name: one for one in OWN_FORMATS}
    if name not in known:
        known |= {one.name: one for one in _added() if one.name not in known}
    if name in known:
        return known[name]
    near = did_you_mean(name, tuple(known)) or f"there are {', '.join(known)}"
    raise BagError("; ".join((f"there is no storage '{name}' of bags", near, *problems_of_added())))


def format_of_suffix(suffix: str) -> StorageFormat | None:
    """Return the format whose files end so, None when there is none."""
    found = _by_suffix(OWN_FORMATS, suffix)
    return _by_suffix(_added(), suffix) if found is None and suffix else found


def format_of_start(start: bytes, suffix: str) -> StorageFormat | None:
    """Return the format of a file by its first bytes, else by its suffix where that alone tells.

    Args:
        start: the first 16 bytes, fewer of a shorter file.
        suffix: of the file's name.
    """
    for one in OWN_FORMATS:
        if start.startswith(one.magic):
            return one
    for one in _added():
        if start.startswith(one.magic) if one.magic else suffix == one.suffix:
            return one
    return None


def check_compression(form: StorageFormat, compression: str) -> None:
    """Refuse a compression that a format's writer does not know.

    Raises:
        BagError: names those that it knows.
    """
    known = ("none", *form.compressions)
    if compression and compression not in known:
        offered = ", ".join(known)
        raise BagError(f"{form.name} knows no compression '{compression}', but {offered}")


def _by_suffix(formats: tuple[StorageFormat, ...], suffix: str) -> StorageFormat | None:
    return next((one for one in formats if one.suffix == suffix), None)


def _added() -> tuple[StorageFormat, ...]:
    extensions = load_extensions(ExtensionGroup.BAG_STORAGE, StorageFormat)
    return tuple(one.part for one in extensions.parts)
