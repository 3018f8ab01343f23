"""Any bag by its path, for reading and for writing."""

from __future__ import annotations

from pathlib import Path

from gazelle.bag.mcap import McapBag, McapWriter
from gazelle.bag.mcap.fields import MAGIC as MCAP_MAGIC
from gazelle.bag.records import BagError, BagReader, BagWriter, Storage
from gazelle.bag.ros1 import CHUNK_BYTES, Compression, Ros1Bag, Ros1Writer
from gazelle.bag.rosbag2 import PackedFile, Rosbag2, Rosbag2Writer, SqliteBag, SqliteWriter
from gazelle.bag.zstandard import ZSTD_MAGIC
from gazelle.diagnostics import did_you_mean
from gazelle.documents.names import is_file, is_folder

__all__ = ["create_bag", "open_bag", "storage_of"]

_SQLITE_MAGIC = b"SQLite format 3\0"
_SUFFIXES = {".bag": Storage.ROS1, ".mcap": Storage.MCAP, ".db3": Storage.SQLITE}


def open_bag(path: Path | str) -> BagReader:
    """Open a bag of any format: a file, or the folder of rosbag2.

    Raises:
        BagError: it is not there, cannot be read, or is no bag.
    """
    path = Path(path)
    if is_folder(path):
        return Rosbag2(path)
    if not is_file(path):
        near = did_you_mean(path.name, _bags_beside(path))
        raise BagError(
            f"Error opening file: {path}: No such file or directory; {near}".rstrip("; ")
        )
    with path.open("rb") as file:
        start = file.read(16)
    if start.startswith(MCAP_MAGIC):
        return McapBag(path)
    if start == _SQLITE_MAGIC:
        return SqliteBag(path)
    if start.startswith(ZSTD_MAGIC):
        return PackedFile(path, open_bag)
    if not start and path.suffix != ".bag":
        raise BagError(f"{path}: the file is empty")
    return Ros1Bag(path)


def create_bag(
    path: Path | str,
    storage: Storage,
    *,
    compression: str = "",
    chunk_bytes: int = CHUNK_BYTES,
    overwrite: bool = False,
) -> BagWriter:
    """Create a bag.

    Args:
        path: a file; without suffix, the folder of rosbag2 for its two formats.
        storage: the format.
        compression: ``bz2`` or ``lz4`` in ROS 1's, ``lz4`` or ``zstd`` in MCAP.
        chunk_bytes: when a chunk is full.
        overwrite: write over a folder that is there; files always are.

    Raises:
        BagError: the file system refuses it, or the format knows no such compression.
    """
    path = Path(path)
    known = {Storage.ROS1: ("none", "bz2", "lz4"), Storage.MCAP: ("none", "lz4", "zstd")}
    if compression and compression not in known.get(storage, ("none",)):
        offered = ", ".join(known.get(storage, ("none",)))
        raise BagError(f"{storage} knows no compression '{compression}', but {offered}")
    if storage is Storage.ROS1:
        chosen = Compression(compression or "none")
        return Ros1Writer(path, compression=chosen, chunk_bytes=chunk_bytes)
    compression = compression.removeprefix("none")
    if path.suffix not in _SUFFIXES:
        return Rosbag2Writer(path, storage, compression=compression, overwrite=overwrite)
    if storage is Storage.SQLITE:
        return SqliteWriter(path)
    return McapWriter(path, compression=compression, chunk_bytes=chunk_bytes)


def storage_of(path: Path | str) -> Storage | None:
    """Return the format that a file's name asks for, None when it names none."""
    name = Path(path).name.removesuffix(".active")
    return _SUFFIXES.get(Path(name).suffix)


def _bags_beside(path: Path) -> list[str]:
    folder = path.parent
    return [one.name for one in folder.iterdir()] if folder.is_dir() else []
