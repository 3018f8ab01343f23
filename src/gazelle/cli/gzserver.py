"""``gzserver [options] [world]`` and ``gazebo``: a world without a launch file."""

from __future__ import annotations

import os

from gazelle.launch.real_ros import start_bridges
from gazelle.nodes.__main__ import main as run_node

__all__ = ["main"]

# They only print.
_OPTIONS = frozenset({"-h", "--help", "-v", "--version"})


def main(argv: list[str]) -> int:
    """Run a world in this process until Ctrl-C."""
    os.environ.setdefault("ROS_NAMESPACE", "/")
    if not _OPTIONS & set(argv):
        start_bridges(os.environ)
    return run_node(["gazebo_ros/gzserver", *argv])
