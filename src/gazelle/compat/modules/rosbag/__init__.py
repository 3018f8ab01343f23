"""rosbag, on Gazelle's bags."""

from gazelle.compat.bags.rosbag import (
    Bag,
    Compression,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)

from . import bag

__all__ = [
    "Bag",
    "Compression",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "bag",
]
