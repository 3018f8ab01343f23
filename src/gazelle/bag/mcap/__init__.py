"""MCAP files (https://mcap.dev/spec), as rosbag2 writes them."""

from __future__ import annotations

from gazelle.bag.mcap.reader import McapBag
from gazelle.bag.mcap.writer import McapWriter

__all__ = ["McapBag", "McapWriter"]
