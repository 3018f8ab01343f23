"""rosbag2's bags: a folder with ``metadata.yaml`` and ``.mcap`` or ``.db3`` files."""

from __future__ import annotations

from gazelle.bag.rosbag2.folder import Rosbag2, Rosbag2Writer, reindex
from gazelle.bag.rosbag2.metadata import Metadata, read_metadata, write_metadata
from gazelle.bag.rosbag2.packed import PackedFile
from gazelle.bag.rosbag2.sqlite import SqliteBag, SqliteWriter

__all__ = [
    "Metadata",
    "PackedFile",
    "Rosbag2",
    "Rosbag2Writer",
    "SqliteBag",
    "SqliteWriter",
    "read_metadata",
    "reindex",
    "write_metadata",
]
