"""``gzserver [options] [world]`` and ``gazebo``: a world without a launch file."""

from __future__ import annotations

import os

from gazelle.nodes.__main__ import main as run_node

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run a world in this process until Ctrl-C."""
    os.environ.setdefault("ROS_NAMESPACE", "/")
    return run_node(["gazebo_ros/gzserver", *argv])
