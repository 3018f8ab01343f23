"""ROS 1's ``.bag`` files, format 2.0 (http://wiki.ros.org/Bags/Format/2.0)."""

from __future__ import annotations

from gazelle.bag.ros1.chunks import CHUNK_BYTES, Compression
from gazelle.bag.ros1.reader import Ros1Bag
from gazelle.bag.ros1.writer import Ros1Writer

__all__ = ["CHUNK_BYTES", "Compression", "Ros1Bag", "Ros1Writer"]
