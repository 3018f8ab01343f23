"""rosbag2's bags: a folder with ``metadata.yaml`` and files such as ``.mcap`` and ``.db3``."""

from __future__ import annotations

from gazelle.bag.rosbag2.folder import Rosbag2, Rosbag2Writer, reindex
from gazelle.bag.rosbag2.metadata import Metadata, read_metadata, write_metadata
from gazelle.bag.rosbag2.packed import PackedFile

__all__ = [
    "Metadata",
    "PackedFile",
    "Rosbag2",
    "Rosbag2Writer",
    "read_metadata",
    "reindex",
    "write_metadata",
]
