"""rosbag, on Gazelle's bags."""

from gazelle.compat.rosbag import (
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
