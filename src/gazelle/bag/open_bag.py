"""Any bag by its path, for reading and for writing."""

from __future__ import annotations

from pathlib import Path

from gazelle.bag.compression_formats import ZSTD_MAGIC
from gazelle.bag.formats import (
    OWN_FORMATS,
    ROS1,
    UNFINISHED,
    Packing,
    check_compression,
    format_of_name,
    format_of_start,
    format_of_suffix,
)
from gazelle.bag.ros1 import CHUNK_BYTES
from gazelle.bag.rosbag2 import CompressedFile, Rosbag2, Rosbag2Writer
from gazelle.bag.storage import BagError, BagReader, BagWriter
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, render
from gazelle.documents.files import is_file, is_folder

__all__ = ["create_bag", "open_bag", "storage_of", "warn_of_unindexed"]


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
    if start.startswith(ZSTD_MAGIC):
        return CompressedFile(path, open_bag)
    found = format_of_start(start, path.suffix)
    if found is None and not start and path.suffix != ROS1.suffix:
        raise BagError(f"{path}: the file is empty")
    # ROS 1's reader says best what else a file may be.
    return (found or ROS1).open(path)


def create_bag(
    path: Path | str,
    storage: str,
    *,
    compression: str = "",
    chunk_bytes: int = CHUNK_BYTES,
    overwrite: bool = False,
) -> BagWriter:
    """Create a bag.

    Args:
        path: a file; without suffix, the folder of rosbag2 for the formats of such.
        storage: name of the format.
        compression: one that the format knows: ``bz2`` or ``lz4`` in ROS 1's, ``lz4`` or
            ``zstd`` in MCAP.
        chunk_bytes: when a chunk is full.
        overwrite: write over a folder that is there; files always are.

    Raises:
        BagError: the file system refuses it, there is no such format, or it knows no such
            compression.
    """
    path, form = Path(path), format_of_name(storage)
    check_compression(form, compression)
    compression = compression.removeprefix("none")
    named = {one.suffix for one in (*OWN_FORMATS, form)}
    if form.in_folder and path.suffix not in named:
        return Rosbag2Writer(path, form.name, compression=compression, overwrite=overwrite)
    return form.create(path, Packing(compression, chunk_bytes))


def storage_of(path: Path | str) -> str | None:
    """Return the format that a file's name asks for, None when it names none."""
    name = Path(path).name.removesuffix(UNFINISHED)
    found = format_of_suffix(Path(name).suffix)
    return None if found is None else found.name


def warn_of_unindexed(bag: BagReader) -> None:
    """Say on stderr that a bag was not closed, and what that means."""
    summary = bag.summary
    if summary.is_indexed:
        return
    tool = format_of_name(bag.storage).reindex
    lost = f"; its last {summary.lost} bytes are no whole piece" if summary.lost else ""
    text = f"the bag was not closed{lost}; {summary.messages} messages can be read"
    found = Diagnostics()
    found.report("bag.unindexed", text, SourceSpan(str(bag.path)), fix=f"run `{tool} {bag.path}`")
    render(found)


def _bags_beside(path: Path) -> list[str]:
    folder = path.parent
    return [one.name for one in folder.iterdir()] if folder.is_dir() else []
