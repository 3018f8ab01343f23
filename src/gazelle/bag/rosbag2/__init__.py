"""rosbag2's bags: a folder with ``metadata.yaml`` and files such as ``.mcap`` and ``.db3``."""

from __future__ import annotations

from gazelle.bag.rosbag2.compression_modes import CompressedFile
from gazelle.bag.rosbag2.folder import Rosbag2, Rosbag2Writer, reindex
from gazelle.bag.rosbag2.metadata import Metadata, read_metadata, write_metadata

__all__ = [
    "CompressedFile",
    "Metadata",
    "Rosbag2",
    "Rosbag2Writer",
    "read_metadata",
    "reindex",
    "write_metadata",
]
