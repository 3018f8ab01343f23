"""``ros2 bag reindex``."""

from __future__ import annotations

import argparse
from pathlib import Path

from gazelle.bag import BagError
from gazelle.bag.rosbag2 import reindex

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Write a bag's ``metadata.yaml`` from its files."""
    about = "Reconstruct metadata file for a bag"
    parser = argparse.ArgumentParser(prog="ros2 bag reindex", description=about)
    parser.add_argument("bag_path", help="Bag to open")
    parser.add_argument("-s", "--storage", help="accepted: the files themselves tell their format")
    options = parser.parse_args(argv)
    path = Path(options.bag_path)
    if not path.is_dir():
        raise BagError(f"Bag path '{path}' is not the folder of a bag")
    print(f"Reindexing files in {path}")
    reindex(path)
    print("Reindexing complete.")
    return 0
