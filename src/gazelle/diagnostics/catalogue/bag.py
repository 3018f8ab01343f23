"""Codes of bags."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "bag.not-converted",
        "warning",
        "A topic of a bag cannot be written in the other format",
        "ROS 1's and ROS 2's bytes differ, so each message must be read, and nothing says how.",
        "put the package that defines the type into the workspace, or keep the bag's own format",
        "Unable to load msg",
    ),
    Entry(
        "bag.unindexed",
        "warning",
        "A bag was not closed",
        "Its recorder was killed. Gazelle reads what is there; rosbag's own tools want the index.",
        "run `rosbag reindex` (ROS 1) or `ros2 bag reindex` to write the index",
        "bag unindexed",
    ),
    Entry(
        "bag.other-definition",
        "warning",
        "A bag and this machine define a type differently",
        "The messages are read and published as the bag defines them; nodes that know the other "
        "definition cannot read them.",
        "use the version of the package that the bag was recorded with",
        "md5sum mismatch",
    ),
    Entry(
        "bag.storage-not-loaded",
        "warning",
        "A package's format of bags cannot be loaded",
        "A pip package adds a storage by the entry points gazelle.bag_storage, and what it names "
        "is not there or is none. All other formats are read and written.",
        "upgrade the package, or uninstall it",
        "Could not load/open plugin",
    ),
)
