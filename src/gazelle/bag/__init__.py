"""Bags: recording, reading, playing and converting them, in ROS 1's and rosbag2's formats."""

from __future__ import annotations

from gazelle.bag.open_bag import create_bag, open_bag, storage_of
from gazelle.bag.storage import (
    BagError,
    BagMessage,
    BagReader,
    BagWriter,
    Connection,
    Encoding,
    Pack,
    Storage,
    Summary,
)
from gazelle.bag.types import (
    BagTypes,
    bag_types,
    cdr_connection,
    converter,
    learn_definitions,
    message_class,
    ros1_connection,
    ros1_name_of,
    wire_name_of,
)

__all__ = [
    "BagError",
    "BagMessage",
    "BagReader",
    "BagTypes",
    "BagWriter",
    "Connection",
    "Encoding",
    "Pack",
    "Storage",
    "Summary",
    "bag_types",
    "cdr_connection",
    "converter",
    "create_bag",
    "learn_definitions",
    "message_class",
    "open_bag",
    "ros1_connection",
    "ros1_name_of",
    "storage_of",
    "wire_name_of",
]
